"""The help of the command line: whole sentences, and words for what an option takes."""

from typing import Any, get_args

from typer.core import TyperGroup


class FullHelp(TyperGroup):
    """A group whose help says the whole first sentence of every command, and what its options take in plain words."""

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Return a command by its name."""
        command = super().get_command(ctx, cmd_name)
        for option in getattr(command, "params", ()):
            if getattr(option, "metavar", None) is None and not getattr(option, "is_flag", True):
                option.metavar = value_word(option)
            if getattr(option, "param_type_name", "") == "argument":
                # The name says what it is; a type of Python beside it says nothing to who does not write Python.
                option.metavar = (option.metavar or option.name or "").upper()
                option.display_type_rich = lambda ctx: ""
        return command

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the list of commands."""
        shown = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        with formatter.section("Commands"):
            formatter.write_dl([(name, first_sentence(c.help or "")) for name, c in shown if c and not c.hidden])


#: What an option takes, by its type.
VALUES = {"Path": "FILE", "int": "N", "float": "NUMBER", "str": "TEXT"}


def value_word(option: Any) -> str | None:
    """Return the word for what an option takes, in the place of a type of Python; None where Typer does not say."""
    kind = getattr(getattr(option, "type_descriptor", None), "annotation", None)
    (kind,) = get_args(kind) or (kind,)
    return VALUES.get(getattr(kind, "__name__", ""))


def first_sentence(text: str) -> str:
    """Return the first sentence of a help text."""
    paragraph = " ".join(text.strip().split("\n\n")[0].split())
    return paragraph.split(". ")[0].rstrip(".") + "."
