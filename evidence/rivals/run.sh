#!/bin/sh
# Measures Shadowstep and its rivals and writes docs/speed-against-error.md: ./run.sh [PROBLEM …]
set -e
cd "$(dirname "$0")"
if ! [ -x build/venv/bin/python ] || ! cmp -s requirements.txt build/venv/requirements.txt; then
    python3 -m venv build/venv
    build/venv/bin/pip install --quiet -r requirements.txt
    cp requirements.txt build/venv/requirements.txt
fi
exec build/venv/bin/python run.py "$@"
