#!/usr/bin/env bash
# Tries the last commit on another release of Debian, as a new user would: the release is installed in a
# temporary folder, the project cloned there, and the README's two commands (or COMMAND) are run in the clone.
#   tools/try_on.sh trixie
#   tools/try_on.sh trixie './dev run examples/01-leaves/leaves.toml'
# It needs root and debootstrap (./dev setup check), and leaves nothing behind. The exit status is COMMAND's.
set -euo pipefail

cd "$(dirname "$0")/.."

fail() {
    printf 'tools/try_on.sh: %s\n' "$*" >&2
    exit 2
}

[[ $# -eq 1 || $# -eq 2 ]] || fail "usage: tools/try_on.sh RELEASE [COMMAND]"
release=$1
command=${2:-'./dev run examples/01-leaves/leaves.toml && ./dev test'}
[[ $release =~ ^[a-z]+$ ]] || fail "'$release' is no name of a release; give one such as trixie"
[[ $(id -u) -eq 0 ]] || fail "only root can install a release into a folder; run it as root"
command -v debootstrap >/dev/null || fail "debootstrap is missing; install it: ./dev setup check"

folder=$(mktemp -d)
trap 'rm -rf --one-file-system "$folder"' EXIT
root=$folder/root
if ! debootstrap --variant=minbase "$release" "$root" >"$folder/log" 2>&1; then
    tail -n 20 "$folder/log" >&2
    fail "debootstrap could not install '$release'"
fi
git clone -q "$PWD" "$root/root/quasimc"
cp /etc/resolv.conf "$root/etc/"

# Mounts in a private namespace disappear with its last process.
# shellcheck disable=SC2016  # expanded by the inner shell
unshare --mount sh -euc '
    mount --rbind /proc "$1/proc"
    mount -t tmpfs none "$1/dev/shm"
    HOME=/root LC_ALL=C.UTF-8 exec chroot "$1" /bin/bash -c "cd /root/quasimc && $2"
' sh "$root" "$command"
