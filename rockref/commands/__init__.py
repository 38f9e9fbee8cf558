"""The commands of the command line, a small module each.

A module in this folder has one function ``register(app)`` that adds its commands to the Typer application. At its head
it imports only Typer and the standard library; what a command needs is imported inside the command, so that
``rockref --help`` stays quick. To add a command: write the module, append its name to :data:`MODULES`.
"""

# The order is the order in `rockref --help`. A name here without its module is an error at once, never skipped.
MODULES: tuple[str, ...] = (
    "demo",
    "new",
    "simulate",
    "shake",
    "compare",
    "fit",
    "identify",
    "sensitivity",
    "diagnose",
    "add",
    "plan",
    "effects",
    "blind",
    "lab",
    "conform",
    "imports",
    "reproduce",
    "version_info",
)
