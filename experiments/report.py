# SPDX-License-Identifier: Apache-2.0
"""What an experiment hands back, and how it becomes CSV files and a Markdown page."""
import csv
import pathlib
from dataclasses import dataclass, field


@dataclass
class Table:
    """Rows under columns. A column is (heading, format), for example ("PSNR / dB", ".1f"); text has the format ""."""

    name: str
    caption: str
    columns: list
    rows: list

    def write_csv(self, folder):
        """Every digit that was measured, in FOLDER/NAME.csv."""
        with open(pathlib.Path(folder) / f"{self.name}.csv", "w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow([heading for heading, _ in self.columns])
            writer.writerows(self.rows)

    def markdown(self, folder):
        """A Markdown table under its caption. A missing value (None) is an empty cell."""
        del folder
        lines = [
            "| " + " | ".join(heading for heading, _ in self.columns) + " |",
            "|" + "|".join("---" if not form else "---:" for _, form in self.columns) + "|",
        ]
        for row in self.rows:
            cells = [_cell(value, form) for value, (_, form) in zip(row, self.columns)]
            lines.append("| " + " | ".join(cells) + " |")
        return f"{self.caption}\n\n" + "\n".join(lines)


def _cell(value, form):
    if value is None:
        return ""
    return value if isinstance(value, str) else format(value, form)


@dataclass
class Picture:
    """A PNG in the output folder."""

    file: str
    caption: str

    def markdown(self, folder):
        return f"![{self.caption}]({folder}/{self.file})\n\n*{self.caption}*"


@dataclass
class Finding:
    """One thing the paper (or the scheme's theory) says, whether the measurement agrees, and why or why not."""

    claim: str
    holds: bool
    reason: str = ""

    def markdown(self, folder):
        del folder
        verdict = "Agrees" if self.holds else "Does not agree"
        return f"- **{verdict}:** {self.claim}" + (f" {self.reason}" if self.reason else "")


@dataclass
class Text:
    """A paragraph in Markdown."""

    content: str

    def markdown(self, folder):
        del folder
        return self.content


@dataclass
class Result:
    """A section of the page: a title and blocks (Text, Table, Picture, Finding) in reading order."""

    title: str
    blocks: list = field(default_factory=list)

    def add(self, *blocks):
        self.blocks.extend(blocks)

    def of_type(self, kind):
        return [block for block in self.blocks if isinstance(block, kind)]

    def table(self, name):
        """The table of that name (for tests)."""
        return next(table for table in self.of_type(Table) if table.name == name)

    def write_tables(self, folder):
        for table in self.of_type(Table):
            table.write_csv(folder)

    def markdown(self, folder):
        """The section, with the pictures' links relative to the page: FOLDER/FILE."""
        return f"## {self.title}\n\n" + "\n\n".join(block.markdown(folder) for block in self.blocks) + "\n"
