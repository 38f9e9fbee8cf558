"""What goes wrong, said so that the reader can mend it."""


class RockrefError(Exception):
    """The root of every error that rockref raises on purpose."""


class InputError(RockrefError, ValueError):
    """Input that cannot be used. The command line prints it and ends with exit code 2.

    Parameters
    ----------
    code : str
        Stable identifier, for example ``"E-UNIT"``; the documentation lists them with the cure.
    where : str
        The file, and the line, column or key in it; or the name of the argument.
    what : str
        What is wrong, with the value that was found.
    cure : str
        What to do about it.
    """

    def __init__(self, code: str, where: str, what: str, cure: str):
        self.code, self.where, self.what, self.cure = code, where, what, cure
        super().__init__(f"{where}: {what}. {cure} [{code}]")


class NumericalError(RockrefError, ArithmeticError):
    """A run that stopped because a number was no longer finite: at which step, at which point.

    Same arguments as :class:`InputError`.
    """

    def __init__(self, code: str, where: str, what: str, cure: str):
        self.code, self.where, self.what, self.cure = code, where, what, cure
        super().__init__(f"{where}: {what}. {cure} [{code}]")


class Interrupted(RockrefError):
    """Work that a person has stopped: what was kept of it. The command line prints it and ends with exit code 130."""
