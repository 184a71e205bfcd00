# SPDX-License-Identifier: Apache-2.0
"""The structs, numbers and functions of ctypes against those that a C compiler sees."""

import ctypes
import re
import shutil
import subprocess

import pytest
from conftest import REPOSITORY

import tetrakis
from tetrakis import _components_library as p
from tetrakis import _errors, _values
from tetrakis import _library as c
from tetrakis import _mosaic_library as m
from tetrakis import _receiver_library as r
from tetrakis import _sequence_library as s

NAMES = ("tetrakis.h", "components.h", "mosaic.h", "sequence.h", "transmit.h")
HEADERS = [REPOSITORY / "include" / "tetrakis" / name for name in NAMES]
STRUCTS = {**c.STRUCTS, **p.STRUCTS, **m.STRUCTS, **s.STRUCTS, **r.STRUCTS}
PROTOTYPES = {**c.PROTOTYPES, **p.PROTOTYPES, **m.PROTOTYPES, **s.PROTOTYPES, **r.PROTOTYPES}


@pytest.fixture(scope="module")
def header():
    text = "".join(header.read_text() for header in HEADERS)
    text = text.partition("/* ---- transmitters")[0]  # the last part, which the package never calls
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def fields_of(header):
    """(struct, field) in the header's order. `double x, y[6];` declares x and y."""
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\}", header, re.S):
        for declaration in filter(str.strip, body.split(";")):
            for declarator in declaration.split(","):
                yield name, re.search(r"(\w+)\s*(?:\[\d+\])?\s*$", declarator).group(1)


def compiled(folder, lines):
    """What a C program with these lines prints, as rows of words."""
    source, program = folder / "probe.c", folder / "probe"
    body = "\n".join(lines)
    source.write_text(
        "#include <stdio.h>\n#include <tetrakis/components.h>\n#include <tetrakis/mosaic.h>\n"
        "#include <tetrakis/transmit.h>\n"
        f"int main(void) {{\n{body}\nreturn 0; }}\n"
    )
    include = HEADERS[0].parents[1]
    subprocess.run(["cc", "-std=c99", "-I", include, source, "-o", program], check=True)
    printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    return [tuple(line.split()) for line in printed.splitlines()]


def layout_of(structs):
    rows = []
    for name, struct in structs.items():
        rows.append((name, "sizeof", str(ctypes.sizeof(struct)), "0"))
        for field, *_ in struct._fields_:
            place = getattr(struct, field)
            rows.append((name, field, str(place.size), str(place.offset)))
    return rows


@pytest.fixture(scope="module")
def layout(header, tmp_path_factory):
    """(struct, field, size, offset), one row a field, of every struct of the header."""
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    seen, lines = set(), []
    for name, field in fields_of(header):
        if name not in seen:
            seen.add(name)
            lines.append(f'printf("{name} sizeof %zu 0\\n", sizeof({name}));')
        lines.append(
            f'printf("{name} {field} %zu %zu\\n", sizeof((({name}*)0)->{field}), '
            f"offsetof({name}, {field}));"
        )
    return compiled(tmp_path_factory.mktemp("probe"), lines)


def test_structs_lie_as_in_c(layout):
    assert layout_of(STRUCTS) == layout


def test_a_wrong_struct_is_noticed(layout):
    class Swapped(ctypes.Structure):
        _fields_ = [c.Heights._fields_[0], *c.Heights._fields_[:0:-1]]

    class Short(ctypes.Structure):
        _fields_ = c.StreamInfo._fields_[:-1]

    assert layout_of({**STRUCTS, "tks_heights": Swapped}) != layout
    assert layout_of({**STRUCTS, "tks_info": Short}) != layout


def test_numbers_are_those_of_c(header, tmp_path):
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    ours = {f"TKS_{status.name}": int(status) for status in _errors.Status}
    kinds = {"u": "U", "i": "I", "f": "F"}
    for number, dtype in enumerate(_values.SAMPLES):
        ours[f"TKS_{kinds[dtype.kind]}{8 * dtype.itemsize}"] = number
    for number, name in enumerate(c.REGISTRATIONS):
        ours[f"TKS_REGISTRATION_{(name or 'unknown').upper()}"] = number
    for number, name in enumerate(c.WEIGHTS):
        ours[f"TKS_WEIGHTS_{name.upper()}"] = number
    for number, name in enumerate(p.COMPONENT_KINDS):
        ours[f"TKS_COMPONENT_{name.upper()}"] = number
    for name in ("PART_HEIGHTS", "PART_VALIDITY", "PART_TEXTURE", "MESH_CODED", "MESH_BUDGET"):
        ours[f"TKS_{name}"] = getattr(c, name)
    rows = compiled(tmp_path, [f'printf("{name} %d\\n", (int){name});' for name in ours])
    assert {name: int(number) for name, number in rows} == ours
    status = re.search(r"typedef enum tks_status TKS_INT \{(.*?)\}", header, re.S).group(1)
    assert len(re.findall(r"TKS_\w+", status)) == len(_errors.Status)


def test_functions_take_as_many_arguments(header):
    declared = {}
    for name, arguments in re.findall(r"\b(tks_\w+)\(([^()]*)\);", header):
        declared[name] = 0 if arguments == "void" else arguments.count(",") + 1
    assert {name: len(taken) for name, (_, taken) in PROTOTYPES.items()} == {
        name: declared.get(name) for name in PROTOTYPES
    }


def test_version_is_that_of_the_header(header):
    numbers = re.findall(r"define TKS_VERSION_\w+ (\d+)", header)
    assert tetrakis.__version__ == ".".join(numbers)
    assert tetrakis.tks_version() == f"tetrakis {tetrakis.__version__}"


def test_only_the_functions_of_the_header_are_exported():
    if shutil.which("nm") is None:
        pytest.skip("no nm")
    listing = subprocess.run(
        ["nm", "-D", "--defined-only", c.lib._name], check=True, capture_output=True, text=True
    ).stdout
    names = [line.split()[-1] for line in listing.splitlines()]
    assert names and all(name.startswith("tks_") for name in names)
