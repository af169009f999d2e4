"""What a shared library of Swage shows is what its public headers declare.

Usage: symbols.py LIBRARY HEADERS
"""

import pathlib
import re
import subprocess
import sys

library, headers = sys.argv[1:]
declared = set()
for header in pathlib.Path(headers).glob("*.h"):
    declared |= set(re.findall(r"\w+", re.sub(r"//.*", "", header.read_text(encoding="utf-8"))))
shown = subprocess.run(
    ["nm", "--dynamic", "--demangle", "--defined-only", library], capture_output=True, text=True, check=True
).stdout
own = re.findall(r" [TDBVRW] (?:(?:vtable|typeinfo|typeinfo name|VTT) for )?swage::(\w+)", shown)
if len(own) < 100:
    sys.exit(f"{library}: shows {len(own)} names only")
hidden = sorted({name for name in own if name not in declared})
if hidden:
    sys.exit(f"{library}: shows what no public header declares: {', '.join(hidden)}")
foreign = [line for line in shown.splitlines() if " T " in line and "swage::" not in line and not re.search(r" T _(init|fini)$", line)]
if foreign:
    sys.exit(f"{library}: shows what is not Swage's: {foreign[:5]}")
