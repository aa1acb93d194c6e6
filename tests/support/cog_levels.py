"""Random levels whose scripts look, pulse, sleep and send each other messages: two placed ones, two class COGs."""

from __future__ import annotations

import random

MESSAGES = ("startup", "pulse", "timer", "activated", "touched", "user0", "user1", "trigger", "created")
SYMBOLS = """thing a mask=0x405
thing b nolink
cog other
cog third nolink
flex rate=0.5
int i local
int k local
thing seen local
thing kept local
int count=3 local
"""
TIMES = ["0.001", "0.03", "0.1", "0.5", "0.7", "1.0", "3.0", "rate", "0", "-1", "Rand()"]
THINGS = ["a", "b", "GetSenderRef()", "GetLocalPlayerThing()", "seen", "kept", "a[1]", "10", "GetSourceRef()"]
COGS = ["other", "third", "GetSelfCog()", "GetThingClassCog(10)", "GetThingClassCog(12)", "other[Rand()]", "0", "1"]
SENT = ["user0", "user1", "user0", "pulse", "timer"]
LABELS = (*MESSAGES, "look", "nap")


class LevelWriter:
    """Writes one level; the seed says which."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.plain = self.random.random() < 0.6
        """Whether what its scripts mean can be told from their text: one that cannot opens most of a level."""
        self.may_send = True
        """Whether the handler at hand sends messages; those that answer some seldom do, or most levels would hang."""

    def fragment(self) -> list[str]:
        """What `level_with_files` takes."""
        pick = self.random
        things = [f"{n}: {t} {t} .5 .5 .5 0 0 0 0" for n, t in ((10, "lamp"), (11, "lamp"), (12, "box"), (13, "mark"))]
        numbers = ["10", "11", "12", "13", "-1"]
        cogs = ["0", "1", "1", "-1", "7"]
        lines = [
            "World templates 5", "lamp none type=cog cog=lamp.cog", "box none type=cog cog=box.cog",
            "mark none type=ghost", "World things 90", "0: walkplayer walkplayer .5 .5 .2 0 0 0 0", *things,
            "World cogs 2",
        ]  # fmt: skip
        for index, name in enumerate(("one", "two")):
            values = [pick.choice(numbers), pick.choice(numbers), pick.choice(cogs), pick.choice(cogs)]
            lines.append(f"{index}: {name}.cog {' '.join(values)} {pick.choice(['0.25', '0.02', '2'])}")
        for name in ("lamp", "box", "one", "two"):
            lines += [f"== cog/{name}.cog", *self.script().split("\n")]
        return lines

    def script(self) -> str:
        pick = self.random
        handled = [m for m in MESSAGES if pick.random() < 0.6]
        flags = "flags=0x44\n" if pick.random() < 0.05 else ""
        symbols = SYMBOLS.replace("b nolink", "b mask=0x405") if pick.random() < 0.3 else SYMBOLS
        head = flags + "symbols\n" + "".join(f"message {m}\n" for m in handled) + symbols + "end\ncode\n"
        labels = [m for m in LABELS if m in handled or m in ("look", "nap")]
        pick.shuffle(labels)
        parts = [
            f"{label}:\n{self.opening(label)}{self.body(2)}{'return;' * (pick.random() < 0.9)}" for label in labels
        ]
        return head + "\n".join(parts) + "\nreturn;\nend\n"

    def opening(self, label: str) -> str:
        """What gives some handlers a plain meaning, so that not everything is chance."""
        roll = self.random.random()
        if label in ("user0", "user1", "activated", "touched") and roll > 0.9:
            return "seen = FirstThingInView(a, 90, 5, 0xffff);"
        self.may_send = self.random.random() < (0.1 if label in SENT or label == "trigger" else 0.8)
        if label in ("startup", "created", "activated") and roll < 0.6:
            target = "GetSenderRef()" if label == "created" else "a"
            return self.random.choice([
                f"SetPulse({self.time()});", f"SetThingPulse({target}, {self.time()});", f"SetTimer({self.time()});",
                f"SetTimerEx({self.time()}, 1, 2, 3);", f"SetThingTimer({target}, {self.time()});",
                f"CaptureThing(b); SetThingPulse(b, {self.time()});", f"count = 4; SetPulse({self.time()});",
                f"SetThingPulse({target}, {self.time()}); count = 2;",
            ])  # fmt: skip
        if label == "pulse" and roll < 0.15:
            return self.random.choice([
                "count = count - 1; if (!count) SetPulse(0);", "if (count > 0) count = count - 1; else SetPulse(0);",
                "count = count - 1; if (count <= 0) { SetPulse(0); count = 3; }",
                "count = count - 1; if (count <= 0) { SetThingPulse(GetSenderRef(), 0); count = 2; }",
                "count = count + 1; if (count > 6) { SetPulse(0); count = 1; }",
            ])  # fmt: skip
        if label == "pulse" and roll < 0.5:
            return self.random.choice([
                "SetPulse(0);", "SetThingPulse(GetSenderRef(), 0);", "kept = GetSenderRef(); SetThingPulse(kept, 0);",
                "if (Rand() < 0.5) SetPulse(0);", "Sleep(0.25); SetPulse(0);",
            ])  # fmt: skip
        if label == "timer" and roll < 0.5:
            return self.random.choice([
                f"SetTimer({self.time()});", f"SetTimerEx({self.time()}, 1, 2, 3);",
                f"if (Rand() < 0.5) SetTimerEx({self.time()}, 1, 0, 0); else SetTimerEx(1.0, 1, 0, 0);",
                f"SetThingTimer(GetSenderRef(), {self.time()});",
                f"SetTimerEx({self.time()}, 1, 2, 3); SetTimerEx({self.time()}, 1, 2, 3);",
            ])  # fmt: skip
        if label == "nap":
            return self.random.choice(
                ["Sleep(0.25);", "if (Rand() < 0.5) Sleep(0.5); else Sleep(0.3);", "Sleep(rate);"]
            )
        return ""

    def body(self, depth: int) -> str:
        return "\n".join(self.statement(depth) for _ in range(self.random.randint(1, 3))) + "\n"

    def time(self) -> str:
        return self.random.choice(TIMES)

    def thing(self) -> str:
        return self.random.choice(["a", "b", "10", "kept"] if self.plain else THINGS)

    def cog(self) -> str:
        return self.random.choice(["other", "third", "GetSelfCog()", "0", "1"] if self.plain else COGS)

    def statement(self, depth: int) -> str:
        pick = self.random
        roll = pick.random()
        look = f'if (HasLOS({self.thing()}, {self.thing()}) == 1) Print("x");'
        if roll < 0.3 or depth == 0:
            return look
        if roll < 0.42:
            return pick.choice([
                f"Sleep({self.time()});", f"SetPulse({self.time()});", f"SetTimer({self.time()});",
                f"SetThingPulse({self.thing()}, {self.time()});", f"SetThingTimer({self.thing()}, {self.time()});",
                f"SetTimerEx({self.time()}, 1, 0, 0);", f"CaptureThing({self.thing()});", "SetPulse(0);",
                "kept = a;", "kept = b;", "DamageThing(a, 1, 1, b);",
            ])  # fmt: skip
        if roll < 0.58 and self.may_send:
            message = pick.choice(SENT)
            return pick.choice([
                f"SendMessage({self.cog()}, {message});",
                f"SendMessageEx({self.cog()}, {message}, 1, 2, 3, 4);",
                f"SendMessage({self.cog()}, {message});", "SendTrigger(-1, 1, 2, 3, 4, 5);",
            ])  # fmt: skip
        if roll < 0.66:
            return f"if (Rand() < 0.5) {{ {self.body(depth - 1)} }} else {{ {self.body(depth - 1)} }}"
        if roll < 0.74:
            return pick.choice(["call look;", "call nap;", "return;"])
        if roll < 0.82:
            return f"for (i = 0; i < {pick.choice(['2', '3', '5'])}; i = i + 1) {{ {self.body(depth - 1)} }}"
        if roll < 0.87:
            within = self.body(depth - 1)
            loop = f"while (seen != -1) {{ {within} seen = NextThingInView(); }}"
            return f"seen = FirstThingInView(a, 90, 5, 0xffff); {loop}"
        pause = pick.choice(
            [
                f"Sleep({self.time()});",
                f"Sleep({self.time()});",
                "call nap;",
                "if (Rand() < 0.9) Sleep(0.2); else Sleep(0.4);",
            ]
        )
        often = pick.choice(["0.7", "0.7", "0.9", "2"]) if "call" not in pause else pick.choice(["0.5", "0.5", "0.97"])
        return f"while (Rand() < {often}) {{ {self.body(depth - 1)} {pause} }}"
