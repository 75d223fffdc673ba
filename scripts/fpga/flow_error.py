"""The one exception of the flow: a message for the person at the terminal."""


class flow_error(Exception):
    """Says what is wrong, where, and what to do."""
