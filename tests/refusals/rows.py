"""Rows of the program's table, as the modules program_*.py tell them."""

import shlex
from dataclasses import dataclass, field

ROWS = []
_section = ['']


@dataclass
class Row:
    section: str
    command: str
    given: str
    files: dict
    links: dict
    stdout: str
    environment: dict = field(default_factory=dict)
    interrupted: bool = False

    @property
    def arguments(self):
        return shlex.split(self.command)


def section(title):
    _section[0] = title


def row(command, given='', files=None, *, links=None, stdout='', environment=None, interrupted=False):
    """The command is run where `files` lie, and links to what is named beside them."""
    ROWS.append(Row(_section[0], command, given, files or {}, links or {}, stdout, environment or {}, interrupted))
