"""The commands of the command line, a small module each.

A module in this folder has a function of the command's arguments, or a Typer of several. At its head it imports only
Typer and the standard library; what a command needs is imported inside the function, so that ``rockref --help`` stays
quick. To add a command: write the module, append it to :data:`COMMANDS`.
"""

#: Each command with "module.function", in the order of `rockref --help`. One without its module is an error at once,
#: never skipped.
COMMANDS: dict[str, str] = {
    name: f"{name}.{name}"
    for name in (
        "demo new simulate shake compare fit identify sensitivity diagnose add plan effects blind lab conform".split()
    )
} | {"import": "imports.imports", "reproduce": "reproduce.reproduce", "doctor": "version_info.doctor"}
