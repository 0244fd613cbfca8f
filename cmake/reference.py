#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes an index of the pages of `fulmar inspect --markdown` in a folder, and one page of all messages with the comments of their headers.

  cmake/reference.py FOLDER MISSION.yaml... -- HEADER.hpp...
"""
import pathlib
import re
import sys

ROW_CELL = re.compile(r"(?<!\\)\|")


def cells(row):
    return [cell.strip() for cell in ROW_CELL.split(row)[1:-1]]


class Table(list):
    """Rows as {column: text}; a column that the page leaves out is empty."""

    def __init__(self, lines):
        head = cells(lines[0])
        super().__init__(dict(zip(head, cells(line))) for line in lines[2:])


class Component:
    def __init__(self, name):
        self.name, self.doc = name, None  # the first line under its heading
        self.tables = {"Inputs": [], "Outputs": [], "Parameters": []}


class PluginPage:
    def __init__(self, file):
        self.name, self.components, self.types = file.stem, [], {}
        section, sub, table = "", "", []
        for line in file.read_text(encoding="utf-8").splitlines() + [""]:
            if line.startswith("|"):
                table.append(line)
                continue
            if table:
                self.take(section, sub, Table(table))
                table = []
            if line.startswith("## "):
                section, sub = line[3:], ""
                if section not in ("Messages", "Files"):
                    self.components.append(Component(section))
            elif line.startswith("### "):
                sub = line[4:]
            elif line and section and not sub and section not in ("Messages", "Files") and self.components[-1].doc is None:
                self.components[-1].doc = "" if line.startswith("```") else line

    def take(self, section, sub, table):
        if section in ("Messages", "Files"):
            self.types[sub] = table
        elif section:
            self.components[-1].tables[sub] = table

    def faults(self):
        """Items without a description."""
        for component in self.components:
            where = f"{self.name}/{component.name}"
            if not component.doc:
                yield f"{where}: no doc; write static constexpr const char* doc"
            for param in component.tables["Parameters"]:
                if len(param.get("what", "").strip()) < 3:
                    yield f"{where}: the parameter {param['parameter']} has no text"


class Struct:
    def __init__(self, doc):
        self.doc, self.fields = doc, {}  # name -> (type, words)


def structs_of(text):
    """Structs of a header with their /// and ///< comments."""
    found, doc, open_struct, last = {}, [], None, []
    for line in text.splitlines():
        start = re.match(r"struct (\w+)( \{.*)?$", line)
        if line.startswith("///"):
            doc.append(line[3:].strip())
        elif start and start[2]:
            open_struct, last = Struct(" ".join(doc)), []
            found[start[1]] = open_struct
            doc = []
        elif line.startswith("}"):
            open_struct = None
        elif open_struct is not None:
            more = re.match(r"\s*///<\s*(.*)", line)
            if more:
                for name in last:
                    kind, words = open_struct.fields[name]
                    open_struct.fields[name] = (kind, words + " " + more[1])
                continue
            last = take_fields(open_struct, line)
        elif not line.startswith("//"):
            doc = []
    return found


def take_fields(struct, line):
    declaration = re.match(r"\s*([\w:]+(?:<[^;=({]*>)?)\s+(\w+.*?);\s*(?:///<\s*(.*))?$", line)
    if not declaration or declaration[1] in ("static", "using", "return", "friend"):
        return []
    names = re.sub(r"\{[^}]*\}", "", declaration[2])
    names = [re.match(r"\s*(\w+)", part)[1] for part in names.split(",") if re.match(r"\s*\w+\s*(=|$)", part)]
    for name in names:
        struct.fields[name] = (declaration[1], declaration[3] or "")
    return names


def words_of(structs, type_name, path):
    """The comment of the field `path` of a message, else of the struct's field that holds it."""
    found = ""
    for part in path.replace("[]", "").split("."):
        struct = structs.get(type_name)
        if struct is None or part not in struct.fields:
            break
        kind, words = struct.fields[part]
        found = words or found
        type_name = re.sub(r".*[<:]|[,>].*", "", re.sub(r"^(?:std::array|List)<\s*([\w:]+).*", r"\1", kind))
    return found


def cell(text):
    return re.sub(r"(?<!\\)([|])", r"\\\1", text.replace("<", "&lt;"))


def users(pages, port_table, type_name):
    names = [f"[{page.name}/{component.name}]({page.name}.md#{component.name.lower()})" for page in pages for component in page.components
             if any(f"[{type_name}]" in port.get("message", "") for port in component.tables[port_table])]
    return ", ".join(names)


def messages_page(pages, structs):
    text = ["# Messages", "", "What the shipped plugins exchange, and the files that they read. A message is a plain struct; its header is in",
            "`fulmar/msg/`. Angles are radians in memory; tables and JSON show degrees.", ""]
    types = {}
    for page in pages:
        for name, table in page.types.items():
            types.setdefault(name, table)
    for name in sorted(types):
        text += [f"## {name}", ""]
        if name in structs and structs[name].doc:
            text += [structs[name].doc, ""]
        written, read = users(pages, "Outputs", name), users(pages, "Inputs", name)
        files = users_of_file(pages, name)
        text += [line + "  " for line in (f"Written by {written}" if written else "", f"Read by {read}" if read else "",
                                          f"A file, named by {files}" if files else "") if line] + [""]
        text += ["| field | kind | unit | frame | range | what |", "| --- | --- | --- | --- | --- | --- |"]
        for row in types[name]:
            words = cell(words_of(structs, name, row["field"].strip("`")))
            text.append("| " + " | ".join([row["field"], row["kind"], row.get("unit", ""), row.get("frame", ""), row.get("range", ""), words]) + " |")
        text.append("")
    return "\n".join(text)


def users_of_file(pages, type_name):
    names = [f"`{param['parameter'].strip('`')}` of [{page.name}/{component.name}]({page.name}.md#{component.name.lower()})"
             for page in pages for component in page.components for param in component.tables["Parameters"]
             if f"[{type_name}]" in param.get("default", "")]
    return ", ".join(names)


def roles_of(missions):
    """use -> the roles that it fills in the shipped missions"""
    roles = {}
    for mission in missions:
        for role, use in re.findall(r"\{fills: (\w+), use: ([\w./]+)", pathlib.Path(mission).read_text(encoding="utf-8")):
            roles.setdefault(use, set()).add(role)
    return roles


def index_page(pages, roles):
    text = ["# Reference", "", "Written by the plugins themselves. [Messages](messages.md) has every message and file with its fields.", "",
            "| component | fills | what |", "| --- | --- | --- |"]
    for page in pages:
        if not page.components:
            text.append(f"| [{page.name}]({page.name}.md) |  | Hosts components in another language; none of its own. |")
        for component in page.components:
            fills = roles.get(f"{page.name}/{component.name}", set()) | (roles.get(page.name, set()) if component is page.components[0] else set())
            text.append(f"| [{page.name}/{component.name}]({page.name}.md#{component.name.lower()}) | {', '.join(sorted(fills))} | {component.doc} |")
    return "\n".join(text) + "\n"


def main(arguments):
    folder, rest = pathlib.Path(arguments[0]), arguments[1:]
    missions, headers = rest[: rest.index("--")], rest[rest.index("--") + 1 :]
    pages = [PluginPage(file) for file in sorted(folder.glob("*.md")) if file.stem not in ("README", "messages")]
    faults = [fault for page in pages for fault in page.faults()]
    faults += [f"{page.name}: no component" for page in pages if not page.components and page.name != "python"]
    structs = {}
    for header in headers:
        for name, struct in structs_of(pathlib.Path(header).read_text(encoding="utf-8")).items():
            structs.setdefault(name, struct)
    (folder / "messages.md").write_text(messages_page(pages, structs), encoding="utf-8")
    (folder / "README.md").write_text(index_page(pages, roles_of(missions)), encoding="utf-8")
    print("\n".join(faults) if faults else f"{len(pages)} plugins, {sum(len(page.components) for page in pages)} components: all say what they are")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
