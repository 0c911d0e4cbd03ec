"""The one way in which the launcher refuses."""


class Refusal(Exception):
    """Bad input: one line that says what and where; exit code 2."""
