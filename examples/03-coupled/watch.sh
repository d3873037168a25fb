#!/bin/sh
# Plant and light side by side: plant.py prints the steps, and a page in the browser follows them. Takes the words of plant.py.
set -eu

cd "$(dirname "$0")"
exec ./plant.py --view "$@"
