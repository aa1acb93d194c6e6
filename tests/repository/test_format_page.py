"""docs/format.md: the code that reads a file without the runtime is compiled as it stands there, and run."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.model import Level
from tests.runtime.compiler import FLATBUFFERS, compiler
from tests.support.halls import halls
from tests.support.levels import ROOT, level_of, two_rooms

MAIN = r"""
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

int main(int, char** words) {
    std::ifstream in(words[1], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::uint64_t> aligned(bytes.size() / 8 + 1);
    std::memcpy(aligned.data(), bytes.data(), bytes.size());
    const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
    if (!open(data, bytes.size())) return 1;
    const auto* level = jktools::GetLevel(data);
    const auto* g = level->geometry();
    for (std::uint32_t s = 0; s < std::strtoul(words[2], nullptr, 10); ++s) {
        const std::uint32_t first = number(COLUMN(g, surface_corner_start), s);
        const std::uint32_t end = number(COLUMN(g, surface_corner_start), s + 1);
        for (std::uint32_t k = 0; k < end - first; ++k)
            for (const float x : corner(g, s, k)) std::printf("%a ", x);
        for (unsigned lane = 0; lane < 3; ++lane) std::printf("%a ", number(COLUMN(g, surface_normal), s, 3, lane));
        std::printf("%d\n", number(COLUMN(g, surface_adjoin), s, 1, 0, -1));
    }
    for (std::uint32_t i = 0; i < std::strtoul(words[3], nullptr, 10); ++i) std::printf("%s\n", text(level, i).c_str());
}
"""
NAMES = level_of(two_rooms("World sounds 60", *(f"squeak_{i:02}.wav" for i in range(60))))


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = compiler()
    if found is None:
        pytest.skip("no C++ compiler is at hand")
    (code,) = re.findall(r"```cpp\n(.*?)```", (ROOT / "docs/format.md").read_text(), re.DOTALL)
    folder = tmp_path_factory.mktemp("page")
    (folder / "page.cpp").write_text(code + MAIN)
    command = [
        found, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-I", str(ROOT / "runtime"), "-isystem", str(FLATBUFFERS),
        str(folder / "page.cpp"), "-o", str(folder / "page"),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "page"


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("accuracy", ["balanced", "fast"])
@pytest.mark.parametrize("level", [halls(), NAMES], ids=["halls", "names"])
def test_the_page_reads_what_python_reads(
    program: Path, tmp_path: Path, level: Level, accuracy: str, plain: bool
) -> None:
    path = tmp_path / "level.jklb"
    path.write_bytes(compile_level(level, CompileSettings(accuracy=accuracy, plain=plain)))  # type: ignore[arg-type]
    held = CompiledLevel(path.read_bytes())
    words = [str(len(held.surface_flags)), str(len(held.strings))]
    lines = subprocess.run([program, path, *words], capture_output=True, text=True, check=True).stdout.splitlines()
    corners = held.vertices[held.corner_vertex]
    start = held.surface_corner_start.tolist()
    for s, line in enumerate(lines[: len(held.surface_flags)]):
        *numbers, adjoin = line.split()
        wanted = [*corners[start[s] : start[s + 1]].reshape(-1).tolist(), *held.surface_normal[s].tolist()]
        assert [float.fromhex(each) for each in numbers] == wanted
        assert int(adjoin) == held.surface_adjoin[s]
    assert tuple(lines[len(held.surface_flags) :]) == held.strings
