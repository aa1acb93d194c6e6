#!/usr/bin/env bash
# make demo and make test, each alone on an empty Debian 12 and again when everything is there. Needs root, debootstrap.
# What the machine needs to reach its package mirrors (certificates, pip.conf, resolv.conf, PIP_* variables) is handed in.
set -euo pipefail
top=$(git -C "$(dirname "$0")" rev-parse --show-toplevel)
[ "$(id -u)" = 0 ] || { echo "tests/fresh.sh: run as root" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "tests/fresh.sh: install debootstrap" >&2; exit 2; }

work=$(mktemp -d)
cleanup() {
    for place in "$work"/*/; do umount -q "$place/proc" "$place/dev" || true; done
    rm -rf --one-file-system "$work"
}
trap cleanup EXIT

debootstrap --variant=minbase --include=python3,make,ca-certificates bookworm "$work/base" >"$work/log" ||
    { tail -20 "$work/log" >&2; exit 1; }
for file in /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
    [ -e "$file" ] && cp -L --parents "$file" "$work/base"
done

inside() {  # inside ROOT COMMAND...
    local root=$1
    shift
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 CI=true ${PIP_CERT:+PIP_CERT=$PIP_CERT} \
        ${PIP_DEFAULT_TIMEOUT:+PIP_DEFAULT_TIMEOUT=$PIP_DEFAULT_TIMEOUT} \
        chroot "$root" /bin/bash -c "cd /srv/jktools && $*"
}

for target in demo test; do
    root=$work/$target
    cp -a "$work/base" "$root"
    git clone -q "$top" "$root/srv/jktools"
    mount -t proc proc "$root/proc"
    mount --bind /dev "$root/dev"
    for round in empty again; do
        echo "== make $target, $round"
        started=$SECONDS
        inside "$root" make "$target"
        echo "== make $target, $round: $((SECONDS - started)) s"
    done
done
