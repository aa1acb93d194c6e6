"""What to say where the engine's parser stops, and how to read on.

The engine gives up at the first token that fits nowhere. We mend the place, in thought, by the least change that lets
the next tokens be read: one token more or one less. Where none does, the statement is given up (`Unreadable`), and
reading goes on behind its semicolon, at the next brace, or at the next word that starts a statement.
"""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Code, Diagnostic, Label
from jktools.source import Source
from jktools.syntax.cog import faults
from jktools.syntax.cog.header import TYPES
from jktools.syntax.cog.nodes import Call, Name, Number, Unreadable
from jktools.syntax.cog.scanner import Token
from jktools.syntax.cog.stack import Stack
from jktools.syntax.cog.tables import END_OF_CODE, Tables

MOST_FAULTS = 100
"""Places told of one script: what follows a hundred of them is not worth reading as code."""

MOST_MENDED = 400
"""Places mended in one script, those included that are not told because they follow from another."""

LOOK_AHEAD = 5
"""Tokens that a mended place is tried on."""

LEAST_READ = 3
"""Of them, as many must fit; after a statement was given up, a new fault is told only behind as many."""

INSERTED = (";", ")", "]", "(", "}")
CLOSES = {")": "(", "]": "[", "}": "{"}
STATEMENT_WORDS = ("if", "while", "do", "for", "goto", "call", "return")
DECLARING = TYPES | {"string", "bool", "double", "local"}
"""Words that declare a variable in the header, or in another language."""
NO_SWITCH = "there is no switch: write if and else if"
SHOWN = 24


class Recovery:
    """Collects the faults of one script's code."""

    def __init__(self, source: Source, tables: Tables) -> None:
        """Know of no fault yet."""
        self.source = source
        self.tables = tables
        self.faults: list[Diagnostic] = []
        self.stopped: Token | None = None
        """The token at which the engine gives up."""
        self._words = tables.words
        self._end = tables.columns[END_OF_CODE]
        self._statement_columns = {self._words[word] for word in STATEMENT_WORDS}
        self._kept = {self._end, self._words[";"], self._words["{"], *self._statement_columns}
        """Tokens that say where statements end and start: they are never taken for one too many."""
        self._mended = 0
        self._given_up = -1
        """The token at which a statement was last given up."""
        self._quiet_until = 0

    def finish(self) -> list[Diagnostic]:
        """Everything that was told."""
        return self.faults

    # ---- reading on

    def recover(self, stack: Stack, tokens: list[Token], at: int, *, too_deep: bool) -> int:
        """Change stack or tokens so that parsing can go on, and give the token to go on with."""
        self.stopped = self.stopped or tokens[at]
        self._mended += 1
        if len(self.faults) >= MOST_FAULTS or self._mended > MOST_MENDED:
            self._tell(
                faults.TOO_MANY_COG_FAULTS, tokens[at].start, tokens[at].end,
                f"{len(self.faults)} places that the engine cannot read are told, but there are more; the rest is not "
                "looked at",
                "mend the first ones; the rest often follow from them",
            )  # fmt: skip
            return self._stop(stack, tokens, at)
        if too_deep:
            self._tell_once_too_deep(tokens[at])
            return self._give_up(stack, tokens, at)
        inserted, kept = self._best_insertion(stack, tokens, at)
        removed = 0 if tokens[at].column in self._kept else self._fit(stack, tokens[at + 1 : at + 1 + LOOK_AHEAD])
        if self._starts_block_comment(tokens, at):
            return self._skip_block_comment(tokens, at)
        if kept >= min(LEAST_READ, len(tokens) - at) and kept >= removed:
            self._tell_missing(stack, tokens, at, inserted)
            tokens.insert(at, Token(self._words[inserted], stack.end, stack.end, inserted))
            return at
        self._tell_unexpected(stack, tokens, at)
        if removed >= min(LEAST_READ, len(tokens) - at - 1) > 0:
            return at + 1
        self._quiet_until = at + LEAST_READ
        return self._give_up(stack, tokens, at)

    def _best_insertion(self, stack: Stack, tokens: list[Token], at: int) -> tuple[str, int]:
        """The token whose insertion lets most of the next ones be read, and how many."""
        best, most = "", 0
        coming = tokens[at : at + LOOK_AHEAD]
        for text in INSERTED:
            kept = self._fit(stack, [Token(self._words[text], 0, 0, text), *coming]) - 1
            if coming[0].column == self._end and text == "}" and kept == 0:
                kept = 1  # one of several braces that are missing
            if kept > most:
                best, most = text, kept
        return best, most

    def _fit(self, stack: Stack, coming: list[Token]) -> int:
        return self.tables.after(list(stack.states), [token.column for token in coming])

    def _give_up(self, stack: Stack, tokens: list[Token], at: int) -> int:
        """Make one unreadable statement of the one at hand, up to where another may start."""
        if at == self._given_up:  # what stands before it is given up already: this token leads nowhere
            return self._stop(stack, tokens, at) if tokens[at].column == self._end else at + 1
        self._given_up = at
        depth = next(d for d in range(len(stack.states), 0, -1) if self._takes_statement(stack, d))
        entered = [self.tables.entered_by[state] for state in stack.states[depth:]]
        start = stack.starts[depth] if depth < len(stack.starts) else tokens[at].start
        stack.cut(depth)
        after = self._skip(tokens, at, within_for="FOR" in entered, cut=bool(entered))
        end = tokens[after - 1].end if after > at else max(start, stack.end)
        self._push(stack, Unreadable(min(start, end), end))
        return after

    def _skip(self, tokens: list[Token], at: int, *, within_for: bool, cut: bool) -> int:
        """The first token behind a statement that is given up; some progress is made, if only on the stack."""
        words = self._words
        after, parentheses = at, int(within_for)
        while tokens[after].column != self._end:
            column = tokens[after].column
            if column == words[";"] and parentheses <= 0:
                return after + 1
            if column in (words["{"], words["}"]) or (column in self._statement_columns and (cut or after > at)):
                break
            if within_for:
                parentheses += (column == words["("]) - (column == words[")"])
                if parentheses <= 0 and column == words[")"]:
                    return after + 1
            after += 1
        return after

    def _takes_statement(self, stack: Stack, depth: int) -> bool:
        """Whether a statement may stand on so much of the stack; a `do` that has its own waits for `while` alone."""
        state = stack.states[depth - 1]
        above = stack.states[depth] if depth < len(stack.states) else 0
        waiting = self.tables.entered_by[state] == "DO" and self.tables.entered_by[above] == "statement"
        return self.tables.rows[state][self.tables.columns["statement"]] > 0 and not waiting

    def _push(self, stack: Stack, statement: Unreadable) -> None:
        stack.states.append(self.tables.rows[stack.states[-1]][self.tables.columns["statement"]])
        stack.values.append(statement)
        stack.starts.append(statement.start)
        stack.end = max(stack.end, statement.end)

    def _stop(self, stack: Stack, tokens: list[Token], at: int) -> int:
        """Take the rest as one unreadable statement of the outermost level."""
        end = tokens[-1].start
        readable = (
            stack.values[1] if len(stack.states) > 1 and self.tables.entered_by[stack.states[1]] == "body" else []
        )
        start = stack.starts[2] if len(stack.starts) > 2 and readable else tokens[at].start
        stack.cut(1)
        stack.states.append(self.tables.rows[self.tables.start][self.tables.columns["body"]])
        stack.values.append([*readable, Unreadable(min(start, end), end)])
        stack.starts.append(0)
        return len(tokens) - 1

    # ---- block comments

    def _starts_block_comment(self, tokens: list[Token], at: int) -> bool:
        here, behind = tokens[at], tokens[min(at + 1, len(tokens) - 1)]
        return (here.value, behind.value) == ("/", "*") and here.end == behind.start

    def _skip_block_comment(self, tokens: list[Token], at: int) -> int:
        close = at + 2
        while close < len(tokens) - 1 and not (
            (tokens[close].value, tokens[close + 1].value) == ("*", "/")
            and tokens[close].end == tokens[close + 1].start
        ):
            close += 1
        self._tell(
            faults.BLOCK_COMMENT, tokens[at].start, tokens[at].end + 1,
            '"/*" starts no comment: the engine reads it as a division and a multiplication',
            "put // before each line",
        )  # fmt: skip
        return min(close + 2, len(tokens) - 1)

    # ---- what is said

    def _tell(self, code: Code, start: int, end: int, message: str, help: str, *related: Label) -> None:
        label = Label(self.source.span(start, end))
        self.faults.append(Diagnostic(code, code.severity, label, message, help, None, related))

    def _tell_once_too_deep(self, token: Token) -> None:
        if not any(fault.code == faults.CODE_NESTED_TOO_DEEP for fault in self.faults):
            self._tell(
                faults.CODE_NESTED_TOO_DEEP, token.start, token.end,
                "the code is nested deeper here than the 300 symbols that the engine's parser can hold",
                "cut the chain of else-ifs, blocks or brackets in two, or move a part behind a label and call it",
            )  # fmt: skip

    def _tell_missing(self, stack: Stack, tokens: list[Token], at: int, inserted: str) -> None:
        """Tell of a token that was left out; the place is the one that it should follow."""
        token, before = tokens[at], tokens[at - 1] if at else tokens[at]
        found = self._found(token)
        if before.value == ":" and inserted == ";":
            self._tell(
                faults.LABEL_WITHOUT_STATEMENT, tokens[max(at - 2, 0)].start, before.end,
                f"expected a statement behind the label, but found {found}", "put a semicolon behind the colon",
            )  # fmt: skip
        elif before.column == self._words["return"] and inserted == ";" and self._same_line(before, token):
            self._tell(
                faults.RETURN_WITH_VALUE, token.start, token.end,
                f"{before.value} hands over no value, but {found} follows it",
                "write ReturnEx(value); before it, and return; alone",
            )  # fmt: skip
        elif isinstance(before.value, Number) and before.end == token.start and isinstance(token.value, Name):
            self._tell_glued(before, token)
        elif inserted == ";":
            self._tell(
                faults.MISSING_SEMICOLON, before.start, before.end,
                f"expected a semicolon behind {self._found(before)}, but found {found}",
                self._cure_of_semicolon(stack, before),
            )  # fmt: skip
        elif inserted == "(":
            self._tell(
                faults.COG_SYNTAX_ERROR, token.start, token.end,
                f'expected "(" behind {self._found(before)}, but found {found}', "put the condition in parentheses",
            )  # fmt: skip
        else:
            self._tell_unclosed(stack, token, inserted)

    def _tell_unclosed(self, stack: Stack, token: Token, inserted: str) -> None:
        terminal = self.tables.columns[self._name_of(CLOSES[inserted])]
        opened = next(
            (
                start
                for state, start in zip(reversed(stack.states), reversed(stack.starts), strict=True)
                if self.tables.columns.get(self.tables.entered_by[state]) == terminal
            ),
            stack.end,
        )
        if any(f.code == faults.UNCLOSED_BRACKET and f.label.span == self._span(opened) for f in self.faults):
            return
        if self.source.text[opened : opened + 1] != CLOSES[inserted]:
            return  # it was left out too, and that is told
        line = self.source.position(opened).line
        self._tell(
            faults.UNCLOSED_BRACKET, opened, opened + 1,
            f'expected "{inserted}" for the "{CLOSES[inserted]}" on line {line}, but found {self._found(token)}',
            f'put a "{inserted}" before it',
            Label(self.source.span(token.start, token.end), "here"),
        )  # fmt: skip

    def _span(self, start: int) -> object:
        return self.source.span(start, start + 1)

    def _tell_glued(self, number: Token, name: Token) -> None:
        text = self.source.text[number.start : name.end]
        self._tell(
            faults.MALFORMED_NUMBER, number.start, name.end,
            f'expected a number, but "{_cut(text)}" is the number {_cut(self.source.text[number.start : number.end])} '
            f"and the name {_cut(self.source.text[name.start : name.end])}",
            "remove the letters, or put a blank or an operator between",
        )  # fmt: skip

    def _tell_unexpected(self, stack: Stack, tokens: list[Token], at: int) -> None:
        token, before = tokens[at], tokens[at - 1] if at else None
        if at < self._quiet_until:
            return
        found = self._found(token)
        text = str(token.value).lower() if isinstance(token.value, str) else ""
        if text in ("break", "continue"):
            cure = {
                "break": "set a variable that the loop's condition tests, or goto a label behind the loop",
                "continue": "goto a label before the loop's closing brace",
            }
            self._tell(
                faults.UNUSABLE_WORD, token.start, token.end,
                f"{found} is a word that the engine knows, but no statement can be made of it", cure[text],
            )  # fmt: skip
        elif text in ("~", "."):
            self._tell(
                faults.UNUSABLE_WORD, token.start, token.end,
                f"{found} is a sign that the engine knows, but no expression can be made of it", "remove it",
            )  # fmt: skip
        elif text in CLOSES and not self._is_open(stack, CLOSES[text]):
            self._tell(
                faults.STRAY_BRACKET,
                token.start,
                token.end,
                f"{found} closes a bracket here, but none is open",
                "remove it",
            )
        elif before is not None and isinstance(before.value, Number) and before.end == token.start and (
            isinstance(token.value, Name)
        ):  # fmt: skip
            self._tell_glued(before, token)
        else:
            expected = " or ".join(self._expected(stack))
            behind = f" behind {self._found(before)}" if before is not None else ""
            self._tell(
                faults.COG_SYNTAX_ERROR, token.start, token.end,
                f"expected {expected}{behind}, but found {found}", self._cure(stack, before, token),
            )  # fmt: skip

    def _is_open(self, stack: Stack, bracket: str) -> bool:
        return any(self.tables.entered_by[state] == self._name_of(bracket) for state in stack.states)

    def _name_of(self, text: str) -> str:
        column = self._words[text]
        return next(name for name, number in self.tables.columns.items() if number == column)

    def _expected(self, stack: Stack) -> Iterator[str]:
        """What could stand here, in the words of the language."""

        def fits(name: str) -> bool:
            return self.tables.after(list(stack.states), [self.tables.columns[name]]) == 1

        if fits("IF"):
            yield "a statement"
        elif fits("DECIMAL"):
            yield "a value"
        elif fits("NAME"):
            yield "the name of a label"
        signs = [s for s in (";", ")", "]", ",", "(", ":", "{") if fits(self._name_of(s))]
        if not fits("IF"):
            yield from (f'"{s}"' for s in signs if not (s == "(" and fits("DECIMAL")))
        if fits("WHILE") and not fits("IF"):
            yield '"while"'
        if fits("PLUS"):
            yield "an operator"

    def _cure_of_semicolon(self, stack: Stack, before: Token) -> str:
        if isinstance(before.value, Name) and before.value.name in DECLARING:
            return "variables are declared in the symbols: remove the type here"
        if self._calls(stack, "elseif"):
            return 'write "else if"'
        if self._calls(stack, "switch"):
            return NO_SWITCH
        return "end the statement with a ;"

    def _calls(self, stack: Stack, name: str) -> bool:
        """Whether what looks like a call of some name has just been read."""
        written = [v.callee if isinstance(v, Call) else v for v in stack.values[-4:]]
        return any(isinstance(v, Name) and v.name == name for v in written)

    def _cure(self, stack: Stack, before: Token | None, token: Token) -> str:
        text = token.value if isinstance(token.value, str) else ""
        if text == "(" and len(stack.states) > 1 and self.tables.entered_by[stack.states[-2]] in ("CALL", "GOTO"):
            return "goto and call take the name of a label, without parentheses"
        if text == ":" and before is not None and isinstance(before.value, str) and before.value in self._words:
            return f"{before.value} is a keyword and can be no label"
        if text == "{" and self._calls(stack, "switch"):
            return NO_SWITCH
        if before is not None and text == "+" and before.value == "+":
            return "there is no ++: write x = x + 1"
        if before is not None and text == "-" and before.value == "-":
            return "there is no --: write x = x - 1"
        if before is not None and text == "=" and before.value in ("+", "-", "*", "/", "%", "&", "|", "^"):
            return f"there is no {before.value}=: write x = x {before.value} value"
        if text == "+":
            return "there is no unary +: remove it"
        if text == "else":
            return "put the statements between if and else into braces, or remove the semicolon before else"
        if text == ")" and before is not None and before.value == ";":
            return "a for loop needs its third expression: for (i = 0; i < 5; i = i + 1)"
        return "mend the statement; the engine stops reading here"

    def _same_line(self, before: Token, token: Token) -> bool:
        return "\n" not in self.source.text[before.end : token.start]

    def _found(self, token: Token) -> str:
        if token.column == self._end:
            return 'the final "end"' if token.value else "the end of the file"
        text = self.source.text[token.start : token.end]
        return f'"{_cut(text)}"' if not text.startswith('"') else _cut(text)


def _cut(text: str) -> str:
    shown = " ".join(text.split())
    return shown if len(shown) <= SHOWN else f"{shown[: SHOWN - 3]}..."
