"""The texts of a level in fewer bytes, each of which can still be read on its own.

Parts that repeat (`.wav`, `kyfla`) are symbols. In a text a byte below 128 stands for itself, 128 + k for symbol k, and
ESCAPE for the byte behind it: names are ASCII, so that hardly any needs it. It is the idea of FSST (Boncz, Neumann,
Leis: "FSST: Fast Random Access String Compression", VLDB 2020) with the codes the other way round: a text without
symbols is what it is.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence

FIRST, ESCAPE = 0x80, 0xFF
MOST = ESCAPE - FIRST
"""Symbols."""
LONGEST = 8
"""Bytes of a symbol that is looked for; a reader takes longer ones, up to LONGEST_READ."""
LONGEST_READ = 255
ROUNDS = 7
"""Symbols are found by joining parts that stand side by side: so often. More spares no more."""

WORTH = 0.8
"""Symbols are taken when texts and they have at most this share of the bytes: they cost every reader one more step."""

_Starting = Mapping[int, Sequence[tuple[bytes, int]]]
"""By first byte, the symbols that start so with their codes, the longest first."""


def symbols_of(texts: Sequence[bytes]) -> list[bytes]:
    """The parts that spare the most bytes, the best first; the same for the same texts."""
    symbols: list[bytes] = []
    for _ in range(ROUNDS):
        counts = _side_by_side(texts, _by_first(symbols))
        best = sorted(
            (part for part in counts if _gain(part, counts) > 0), key=lambda part: (-_gain(part, counts), part)
        )
        symbols = best[:MOST]
    used = Counter(code for text in coded(texts, symbols) for code in text)
    uses = {part: used[FIRST + place] for place, part in enumerate(symbols)}
    return [part for part in symbols if _gain(part, uses) > 0]


def _side_by_side(texts: Sequence[bytes], starting: _Starting) -> Counter[bytes]:
    """How often each part stands in texts that are cut into symbols, and each two that stand side by side."""
    counts: Counter[bytes] = Counter()
    for text in texts:
        before, at = b"", 0
        while at < len(text):
            part = next(
                (each for each, _ in starting.get(text[at], ()) if text.startswith(each, at)), text[at : at + 1]
            )
            counts[part] += 1
            if before and len(before) + len(part) <= LONGEST:
                counts[before + part] += 1
            before = part
            at += len(part)
    return counts


def _gain(part: bytes, counts: Mapping[bytes, int]) -> int:
    """Bytes that a symbol spares; it stands in the file with a zero byte behind it."""
    return 0 if 0 in part else counts[part] * (len(part) - 1) - len(part) - 1


def written(texts: Sequence[bytes]) -> tuple[list[bytes], list[bytes]]:
    """The texts as a file holds them, and the symbols; where those do not pay none, and a zero byte after each."""
    plain = [text + b"\0" for text in texts]
    symbols = symbols_of(texts)
    short = coded(texts, symbols)
    size = sum(map(len, short)) + sum(len(each) + 1 for each in symbols)
    return (short, symbols) if symbols and size <= WORTH * sum(map(len, plain)) else (plain, [])


def coded(texts: Iterable[bytes], symbols: Sequence[bytes]) -> list[bytes]:
    """Each text in the fewest bytes that these symbols allow."""
    starting = _by_first(symbols)
    return [_shortest(text, starting) for text in texts]


def _shortest(text: bytes, starting: _Starting) -> bytes:
    # From behind: the fewest bytes from each place on, and what to take there.
    cost = [0] * (len(text) + 1)
    choice: list[tuple[bytes, int]] = [(b"", 0)] * len(text)
    for at in range(len(text) - 1, -1, -1):
        byte = text[at]
        plain = bytes([byte]) if byte < FIRST else bytes([ESCAPE, byte])
        cost[at], choice[at] = cost[at + 1] + len(plain), (plain, at + 1)
        for part, code in starting.get(byte, ()):
            if text.startswith(part, at) and cost[at + len(part)] + 1 < cost[at]:
                cost[at], choice[at] = cost[at + len(part)] + 1, (bytes([code]), at + len(part))
    made, at = [], 0
    while at < len(text):
        octets, at = choice[at]
        made.append(octets)
    return b"".join(made)


def _by_first(symbols: Sequence[bytes]) -> _Starting:
    found: dict[int, list[tuple[bytes, int]]] = defaultdict(list)
    for place, part in enumerate(symbols):
        found[part[0]].append((part, FIRST + place))
    for each in found.values():
        each.sort(key=lambda entry: -len(entry[0]))
    return found


def decoded(text: bytes, symbols: Sequence[bytes]) -> bytes:
    """The text that a coded one stands for. Raises IndexError for a code without a symbol, or nothing to escape."""
    made: list[int] = []
    octets = iter(text)
    for byte in octets:
        if byte < FIRST:
            made.append(byte)
        elif byte < ESCAPE:
            made += symbols[byte - FIRST]
        else:
            literal = next(octets, None)
            if literal is None:
                raise IndexError("nothing stands behind the byte 255")
            made.append(literal)
    return bytes(made)
