"""The codes of what makes the engine refuse a script. Each has its page in jktools/linter/rules/text."""

from jktools.diagnostics import Code, Severity

COG_REJECTED = Code("JK050", "cog-rejected", Severity.ERROR)
"""One for each script that the engine refuses; the others below tell the places."""

COG_SYNTAX_ERROR = Code("JK051", "cog-syntax-error", Severity.ERROR)
MISSING_SEMICOLON = Code("JK052", "missing-semicolon", Severity.ERROR)
UNCLOSED_BRACKET = Code("JK053", "unclosed-bracket", Severity.ERROR)
LABEL_WITHOUT_STATEMENT = Code("JK054", "label-without-statement", Severity.ERROR)
UNUSABLE_WORD = Code("JK055", "unusable-word", Severity.ERROR)
EMPTY_CODE = Code("JK056", "empty-code", Severity.ERROR)
MALFORMED_NUMBER = Code("JK057", "malformed-number", Severity.ERROR)
BLOCK_COMMENT = Code("JK058", "block-comment", Severity.ERROR)
RETURN_WITH_VALUE = Code("JK059", "return-with-value", Severity.ERROR)
STRAY_BRACKET = Code("JK060", "stray-bracket", Severity.ERROR)
CODE_NESTED_TOO_DEEP = Code("JK061", "code-nested-too-deep", Severity.ERROR)
OVERLONG_TOKEN = Code("JK062", "overlong-token", Severity.ERROR)
MALFORMED_COG_HEADER = Code("JK063", "malformed-cog-header", Severity.ERROR)
MISSING_COG_PART = Code("JK064", "missing-cog-part", Severity.ERROR)
TOO_MANY_COG_FAULTS = Code("JK065", "too-many-cog-faults", Severity.ERROR)
