# SPDX-License-Identifier: Apache-2.0
"""A folder in which a run of SubdivideVolume is hit by a fault, and what must be true of it afterwards.

The folder holds an old output, and files of others by names that a run might use for itself. After a fault the output
is the old one or the new one, byte for byte, and nothing else has changed or come. A .mhd or .nhdr is compared together
with the voxels that it names."""

import hashlib
import os
import re
import shutil
import subprocess

from subdivide_volume_case import noise
from subdivide_volume_files import write_meta

DECOYS = ("scan", "scan.txt", "scan.raw.bak", "scan.new-abcdef.raw", "other.raw", "image.nii", "probe", "scan.tif.old",
          ".partial-abcdef", ".scan.partial-abcdef", ".scan.pieces", "slices_0000.tif", "note")

# What may be left by a process that was killed without notice: names that no program but this one uses.
LEFT_BY_SIGKILL = re.compile(r"\.partial-\w{6}|\.slices\.partial-\w{6}|\.scan\.\w+\.pieces(\.\w{6})?|"
                             r"\.slices\.pieces(\.\w{6})?|scan\.new-\w{6}\.(raw|zraw|raw\.gz)|scan\.(raw|zraw|raw\.gz)")

# The output, and the options that it is made with.
KINDS = {
    "mha": ("scan.mha", ()),
    "mha compressed": ("scan.mha", ("--compress",)),
    "mhd": ("scan.mhd", ()),
    "mhd compressed": ("scan.mhd", ("--compress",)),
    "nrrd": ("scan.nrrd", ()),
    "nhdr": ("scan.nhdr", ()),
    "nhdr compressed": ("scan.nhdr", ("--compress",)),
    "nii": ("scan.nii", ()),
    "nii.gz": ("scan.nii.gz", ()),
    "hdr": ("scan.hdr", ()),
    "tif": ("scan.tif", ()),
    "tif compressed": ("scan.tif", ("--compress",)),
    "slices": ("slices/", ()),
    "slices compressed": ("slices/", ("--compress",)),
    "levels": ("scan.mha", ("--levels", "2")),
    "in place": ("scan.mha", ()),
    "in place mhd": ("scan.mhd", ()),
    "piece mha": ("scan.mha", ("--piece", "2/2")),
    "piece mhd": ("scan.mhd", ("--piece", "2/2")),
    "piece nhdr": ("scan.nhdr", ("--piece", "2/2")),
    "piece slices": ("slices/", ("--piece", "2/2")),
    "all pieces mhd": ("scan.mhd", ("--piece", "1/1")),
    "all pieces slices": ("slices/", ("--piece", "1/1")),
}
DATA_NAME = re.compile(rb"(ElementDataFile = |data file: )(.*)\n")


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def files_below(folder):
    """The names of all files and empty folders, from that folder on."""
    found = []
    for root, folders, names in os.walk(folder):
        found += [os.path.relpath(os.path.join(root, name), folder) for name in names]
        found += [os.path.relpath(os.path.join(root, name), folder) for name in folders
                  if not os.listdir(os.path.join(root, name))]
    return sorted(found)


class Scene:
    """One kind of output in a folder of its own, which prepare() makes anew."""

    def __init__(self, program, folder, kind, size=24, target=None):
        self.program = program
        self.kind = kind
        self.name, options = KINDS[kind]
        self.options = [*options, "--quiet", "--threads", "2"]
        self.source = os.path.join(folder, "source.mha")
        self.folder = target or os.path.join(folder, "target")
        self.saved = os.path.join(folder, "saved")
        self.is_piece = "--piece" in options
        self.is_in_place = kind.startswith("in place")
        if not os.path.exists(self.source):
            write_meta(self.source, [size] * 3, "H", noise(size ** 3, 0, 60000))
        self.make_outputs()

    @property
    def output(self):
        return os.path.join(self.folder, self.name)

    def get_command(self, *more):
        """The run that is hit."""
        source = self.output if self.is_in_place else self.source
        return [self.program, source, self.output, *self.options, *more]

    def run(self, *arguments, **keywords):
        return subprocess.run(arguments, capture_output=True, text=True, check=False, timeout=120, **keywords)

    def make_outputs(self):
        """The old output, kept aside, and what is to become of it. Grids, voxels and sizes of both headers differ."""
        shutil.rmtree(self.saved, ignore_errors=True)
        os.makedirs(os.path.join(self.saved, "slices" if self.name == "slices/" else ""))
        plain = [option for option in self.options if option not in ("--piece", "1/1", "2/2")]
        old = ["--axes", "xy"] if self.is_in_place else ["--scheme", "linear", "--spacing", "2.5"]
        result = self.run(self.program, self.source, os.path.join(self.saved, self.name), *plain, *old)
        assert result.returncode == 0, result.stderr
        self.prepare()
        self.old = self.get_state()
        self.run(*self.get_command())
        self.new = self.get_state()
        assert None not in (self.old, self.new) and self.old != self.new
        if self.is_piece:
            self.run(self.program, self.source, self.output, *plain)
            assert self.get_state() == self.new
        assert self.get_strays() == []

    def prepare(self):
        """The old output, the decoys, and nothing else; of pieces, all but the last."""
        os.makedirs(self.folder, exist_ok=True)
        for name in os.listdir(self.folder):
            path = os.path.join(self.folder, name)
            shutil.rmtree(path) if os.path.isdir(path) and not os.path.islink(path) else os.remove(path)
        for name in DECOYS:
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(f"{name} is precious\n".encode())
        shutil.copytree(self.saved, self.folder, dirs_exist_ok=True)
        if "2/2" in self.options:
            first = [*self.get_command()]
            first[first.index("2/2")] = "1/2"
            result = self.run(*first)
            assert result.returncode == 0, result.stderr

    def get_parts(self):
        """The names of the files that are the output."""
        if self.name == "slices/":
            if not os.path.isdir(self.output):
                return []
            return ["slices/" + name for name in sorted(os.listdir(self.output))]
        if self.name == "scan.hdr":
            return ["scan.hdr", "scan.img"]
        if not self.name.endswith(("mhd", "nhdr")) or not os.path.exists(self.output):
            return [self.name]
        with open(self.output, "rb") as file:
            return [self.name, DATA_NAME.search(file.read()).group(2).decode()]

    def get_state(self):
        """What the output is, or None where a part of it is missing."""
        state = []
        for number, name in enumerate(self.get_parts()):
            path = os.path.join(self.folder, name)
            if not os.path.exists(path):
                return None
            if self.name.endswith(("mhd", "nhdr")):
                with open(path, "rb") as file:
                    content = file.read()
                content = DATA_NAME.sub(b"", content) if number == 0 else content
                state.append((number, hashlib.sha256(content).hexdigest()))
            else:
                state.append((name, digest(path)))
        return state or None

    def get_strays(self):
        known = {*DECOYS, *self.get_parts()}
        return [name for name in files_below(self.folder) if name not in known]

    def find_fault(self, code, was_killed=False):
        """What is wrong after a run that ended so, in words; empty if nothing is."""
        for name in DECOYS:
            try:
                with open(os.path.join(self.folder, name), "rb") as file:
                    if file.read() != f"{name} is precious\n".encode():
                        return f"{name} was changed"
            except FileNotFoundError:
                return f"{name} is gone"
        state = self.get_state()
        # The names alone make .hdr and .img one image: there is a moment at which one of them is missing.
        may_be_gone = was_killed and self.kind == "hdr"
        if state not in (self.old, self.new) and not (may_be_gone and state is None):
            return "the output is neither the old nor the new one" if state else "the output is not there"
        if code == 0 and state != self.new:
            return "the exit code is 0, and the output is not the new one"
        strays = {name.split("/")[0] for name in self.get_strays()}
        if self.is_piece and code != 0:
            strays.discard(f".{self.name.rstrip('/')}.pieces")
        if was_killed:
            strays = {name for name in strays if not LEFT_BY_SIGKILL.fullmatch(name)}
        return f"{', '.join(sorted(strays))} was left" if strays else ""

    def find_fault_of_next_run(self):
        """The run again, without a fault: it must not be disturbed by what the one before left, nor touch it."""
        strays = set(self.get_strays())
        if self.is_in_place and self.get_state() == self.new:
            return ""
        result = self.run(*self.get_command())
        if result.returncode != 0:
            return f"the next run fails: {result.stderr}"
        if self.get_state() != self.new:
            return "the next run gives another output"
        names = [os.path.basename(name) for name in self.get_parts() if not name.startswith("slices/")]
        if any("new-" in name for name in names):
            return "the next run leaves another name"
        more = {name for name in self.get_strays()} - strays
        return f"the next run leaves {more}" if more else ""
