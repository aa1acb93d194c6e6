"""Random scripts that mean something: loops, jumps, pulses, timers, sleeps, arrays, missing and extra arguments."""

from __future__ import annotations

import random

HEADER = """flags=0x240
symbols
message startup
message pulse
message timer
message activate
message user0
message user1 local
int count=3
int i local
int k=5 local
flex rate=0.5
flex f=0.25 local
vector v local
thing target
thing self local
sector room
cog other
end
code
"""
VARIABLES = ["count", "i", "k", "rate", "f", "v", "target", "self", "room", "other", "extra", "spare"]
NUMBERS = ["0", "1", "2", "3", "-1", "0.5", "10", "0x10", "1.5", "100", "0.05", "16777217", "-0.25"]
ASKING = [
    "GetLocalPlayerThing()", "GetThingType({})", "HasLOS({}, {})", "Rand()", "GetParam({})", "FirstThingInSector({})",
    "NextThingInSector({})", "GetThingPos({})", "VectorX({})", "IsServer()", "GetThingMass({})",
    "VectorSet({}, {}, {})",
    "DamageThing({}, {}, 1, {})", "CreateThing({}, {})", "GetSelfCog()", "SendMessageEx({}, user0, 1, 2, 3, 4)",
]  # fmt: skip
DOING = [
    "SetPulse({});", "SetTimer({});", "SetTimerEx({}, 1, 2, 3);", "Sleep({});", "SendMessage(GetSelfCog(), user1);",
    "Print(\"x\");", "SetThingPulse({}, {});", "MoveToFrame({}, {}, {});", "DestroyThing({});", "SetWallCel({}, {});",
    "ReturnEx({});", "WaitForStop({});", "Sleep({}, {});", "SetPulse();", "NoSuchVerb({});", "{};",
    "SetThingTimer({}, {});",
]  # fmt: skip
OPERATORS = ["+", "-", "*", "/", "%", "<", ">", "<=", ">=", "==", "!=", "&&", "||", "&", "|", "^"]


class Writer:
    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.labels = 0

    def script(self) -> str:
        parts = []
        for label in self.random.sample(["startup", "pulse", "timer", "activate", "user0", "user1", "sub", "more"], 6):
            parts.append(f"{label}:\n{self.body(3, 4)}")
            if self.random.random() < 0.8:
                parts.append("return;\n")
        return HEADER + "".join(parts) + "end\n"

    def body(self, depth: int, most: int) -> str:
        return "".join(self.statement(depth) for _ in range(self.random.randint(1, most)))

    def statement(self, depth: int) -> str:
        roll = self.random.random()
        if depth == 0 or roll < 0.3:
            return self.filled(self.random.choice(DOING)) + "\n"
        if roll < 0.55:
            return f"{self.target()} = {self.expression(2)};\n"
        if roll < 0.68:
            other = f"else {{ {self.body(depth - 1, 2)} }}" if self.random.random() < 0.5 else ""
            return f"if ({self.expression(2)}) {{ {self.body(depth - 1, 3)} }} {other}\n"
        if roll < 0.88:
            return self.loop(depth)
        if roll < 0.92:
            return self.random.choice(["goto sub;", "goto more;", "goto nowhere;", "return;", "stop;"]) + "\n"
        return self.random.choice(["call sub;", "call more;", "call nowhere;"]) + "\n"

    def loop(self, depth: int) -> str:
        variable = self.random.choice(["i", "k", "f", "extra"])
        step = self.random.choice(["1", "2", "0.5", "rate", "count", "-1"])
        test = (
            f"{variable} {self.random.choice(['<', '<=', '>', '>='])} {self.random.choice(['5', 'count', '10.5', '0'])}"
        )
        inner = self.body(depth - 1, 3)
        if self.random.random() < 0.15:
            inner += f"if ({self.expression(1)}) {variable} = 100;\n"
        kind = self.random.random()
        if kind < 0.35:
            return f"for ({variable} = 0; {test}; {variable} = {variable} + {step}) {{ {inner} }}\n"
        if kind < 0.6:
            return f"while ({test}) {{ {inner} {variable} = {variable} + {step}; }}\n"
        if kind < 0.75:
            return f"do {{ {variable} = {step} + {variable}; {inner} }} while ({test});\n"
        pause = self.random.choice(["Sleep(0.25);", "Sleep(rate);", "Sleep(0);", "if (Rand() < 0.5) Sleep(0.1);", ""])
        return f"while ({self.expression(1)}) {{ {inner} {pause} }}\n"

    def target(self) -> str:
        if self.random.random() < 0.15:
            return f"{self.random.choice(VARIABLES)}[{self.expression(1)}]"
        return self.random.choice(VARIABLES)

    def expression(self, depth: int) -> str:
        roll = self.random.random()
        if depth == 0 or roll < 0.25:
            return self.random.choice([*NUMBERS, "'1 2 3'"])
        if roll < 0.5:
            return self.target() if roll < 0.3 else self.random.choice(VARIABLES)
        if roll < 0.75:
            return f"({self.expression(depth - 1)} {self.random.choice(OPERATORS)} {self.expression(depth - 1)})"
        if roll < 0.82:
            return f"{self.random.choice('-!')}{self.expression(0)}"
        if roll < 0.84:
            return f"({self.random.choice(VARIABLES)} = {self.expression(depth - 1)})"
        return self.filled(self.random.choice(ASKING))

    def filled(self, pattern: str) -> str:
        while "{}" in pattern:
            pattern = pattern.replace("{}", self.expression(1) if self.random.random() < 0.9 else "", 1)
        return pattern.replace("(, ", "(1, ").replace(", ,", ", 2,").replace(", )", ")")
