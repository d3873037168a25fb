#!/bin/sh
# Shows plant and light side by side in a page in the browser, which follows the steps that plant.py prints. Takes the
# arguments of plant.py.
set -eu

cd "$(dirname "$0")"
exec ./plant.py --view "$@"
