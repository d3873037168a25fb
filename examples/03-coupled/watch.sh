#!/bin/sh
# Plant and light side by side, in a page in the browser that follows the steps, which plant.py prints. Takes the words of plant.py.
set -eu

cd "$(dirname "$0")"
exec ./plant.py --view "$@"
