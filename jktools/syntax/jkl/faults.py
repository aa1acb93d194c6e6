"""The codes of what can be wrong with a level's text. Each has its page in jktools/linter/rules/text."""

from jktools.diagnostics import Code, Severity

MALFORMED_RECORD = Code("JK001", "malformed-record", Severity.ERROR)
LOOSELY_READ_RECORD = Code("JK002", "loosely-read-record", Severity.WARNING)
MISSING_SECTION = Code("JK003", "missing-section", Severity.ERROR)
COUNT_MISMATCH = Code("JK004", "count-mismatch", Severity.ERROR)
MISSING_END = Code("JK005", "missing-end", Severity.ERROR)
OVERLONG_LINE = Code("JK006", "overlong-line", Severity.ERROR)
COMMENT_IN_NUMBER = Code("JK007", "comment-in-number", Severity.ERROR)
REPEATED_SECTION = Code("JK008", "repeated-section", Severity.WARNING)
TOO_MANY_FAULTS = Code("JK009", "too-many-faults", Severity.ERROR)
CUT_OFF_FILE = Code("JK010", "cut-off-file", Severity.ERROR)
