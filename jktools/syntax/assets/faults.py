"""The codes of what can be wrong inside an asset file. Each has its page in jktools/linter/rules/assets."""

from jktools.diagnostics import Code, Severity

MALFORMED_ASSET = Code("JK030", "malformed-asset", Severity.ERROR)
LOOSELY_READ_ASSET = Code("JK031", "loosely-read-asset", Severity.WARNING)
ASSET_COUNT_MISMATCH = Code("JK032", "asset-count-mismatch", Severity.ERROR)
ASSET_INDEX_OUT_OF_RANGE = Code("JK033", "asset-index-out-of-range", Severity.ERROR)
CUT_OFF_ASSET = Code("JK034", "cut-off-asset", Severity.ERROR)
SURPLUS_IN_ASSET = Code("JK035", "surplus-in-asset", Severity.WARNING)
UNKNOWN_ASSET_VERSION = Code("JK036", "unknown-asset-version", Severity.WARNING)
BROKEN_HIERARCHY = Code("JK037", "broken-hierarchy", Severity.ERROR)
TOO_MANY_ASSET_FAULTS = Code("JK039", "too-many-asset-faults", Severity.ERROR)
MODEL_TOO_LARGE = Code("JK816", "model-too-large", Severity.ERROR)
TOO_MANY_CELS = Code("JK817", "too-many-cels", Severity.WARNING)
TOO_MANY_CLOUD_VERTICES = Code("JK818", "too-many-cloud-vertices", Severity.ERROR)
TOO_MANY_INSTINCTS = Code("JK819", "too-many-instincts", Severity.WARNING)
TOO_MANY_MARKERS = Code("JK820", "too-many-markers", Severity.ERROR)
UNPLAYABLE_SOUND = Code("JK822", "unplayable-sound", Severity.WARNING)
