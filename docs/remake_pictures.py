"""Draw the pictures of README and docs anew, each by the command that stands here.

They are small files beside the pages, because README shows them too. Look at what changes before
you commit it.
"""

import subprocess
import sys
from pathlib import Path

STATIC = Path(__file__).parent / "_static"
PICTURES = {
    "no-go.png": "traverse absolem ibc --flippers stowed --friction 1.0 --side",
    "go.png": "traverse absolem ibc --friction 1.0 --flippers=22deg,flat --side",
    "dimensions.svg": "robots kenaf --figure",
    "weighing.svg": "measure robot --figure",
    "battery.png": "design absolem ibc --flippers=22deg,flat --friction 1.0 "
    "--payload=5kg@200mm,300mm --free=payload.from_front=-300mm..800mm "
    "--free=payload.height=50mm..600mm --figure",
}
"""Commands by the file that they write; a traverse is named after its verdict."""


def main() -> None:
    for name, words in PICTURES.items():
        command = [sys.executable, "-m", "kaidan", *words.split(), str(STATIC / name)]
        done = subprocess.run(command, stdout=subprocess.PIPE, encoding="utf-8")
        print(done.stdout.splitlines()[-1])


if __name__ == "__main__":
    main()
