#!/usr/bin/env python3
"""Gives clang-tidy the unity sources of a build. Those of the product are named so that its analyzer follows what they include.

  unified_sources.py BUILD OUTPUT    writes OUTPUT/compile_commands.json, and the sources of tests to OUTPUT/test; prints the
                                     sources that all of them hold

The analyzer takes an included source for a header, unless the file that includes it is named UnifiedSource... (clang's
AnalysisManager::isInCodeFile). In tests it would take most of the time.
"""

import json
import pathlib
import re
import sys

tests = pathlib.Path(__file__).resolve().parents[1] / "test"
build, output = map(pathlib.Path, sys.argv[1:])
(output / "test").mkdir(parents=True, exist_ok=True)
commands = {command["file"]: command for command in json.loads((build / "compile_commands.json").read_text())}
for index, (source, command) in enumerate(commands.items()):
    text = pathlib.Path(source).read_text()
    included = re.findall(r'^#include "(.*\.cpp)"$', text, re.MULTILINE)
    print(*(included or [source]), sep="\n")
    if included:
        unified = output / (f"test/{index}.cxx" if tests in pathlib.Path(included[0]).parents else f"UnifiedSource{index}.cxx")
        unified.write_text(text)
        command["file"] = str(unified)
        command["command"] = command["command"].replace(source, str(unified))
(output / "compile_commands.json").write_text(json.dumps(list(commands.values())))
