#!/bin/bash
# To be sourced by scripts that build and test in Debian roots of their own. Needs root and debootstrap.

# The archive that apt itself is set up with.
archive() {
  # shellcheck disable=SC2016 # apt's variables
  apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    awk '$1 == "Debian" || $NF ~ /\/debian\/?$/ { print $NF; exit }'
}

# Why no root can be made, or nothing.
why_no_root() {
  if [ "$(id -u)" != 0 ]; then
    echo "only root can make a root"
  elif ! command -v debootstrap >/dev/null; then
    echo "there is no debootstrap"
  elif [ -z "$(archive)" ]; then
    echo "apt knows no Debian archive"
  fi
}

install_in() { # ROOT PACKAGE...
  local root=$1
  shift
  # What is thrown away needs no writing through to the disk.
  chroot "$root" apt-get -o Dpkg::Options::=--force-unsafe-io install --yes --no-install-recommends "$@"
}

# A root of a release, with these packages; its /proc is mounted.
make_root() { # ROOT RELEASE PACKAGE...
  local root=$1 release=$2
  shift 2
  eval "$(apt-config shell http_proxy Acquire::http::Proxy)" # debootstrap doesn't ask apt
  [ -z "${http_proxy:-}" ] || export http_proxy
  # An archive that stands still, or a clock that is ahead, outlives the week that sid's index is valid.
  debootstrap --variant=minbase "$release" "$root" "$(archive)" &&
    mount -t proc proc "$root/proc" &&
    chroot "$root" apt-get -o Acquire::Check-Valid-Until=false update &&
    install_in "$root" "$@"
}

remove_root() { # ROOT
  ! mountpoint --quiet "$1/proc" || umount "$1/proc"
  rm -rf --one-file-system "$1"
}

# The sources, without what was built of them.
copy_sources() { # FROM ROOT
  mkdir "$2/gale" && tar -C "$1" --exclude=./.git --exclude='./build*' -cf - . | tar -C "$2/gale" -xf -
}
