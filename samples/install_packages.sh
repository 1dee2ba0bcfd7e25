# Sourced by the two commands a person starts with; installs the Debian packages that are missing:
#   install_packages build    what the program stands on
#   install_packages test     and what its tests need
# This is the one list of them.

build_packages="g++ cmake ninja-build libpng-dev zlib1g-dev libopenimageio-dev libimath-dev libopencv-core-dev libopencv-imgproc-dev
  libcli11-dev nlohmann-json3-dev libtbb-dev libhwy-dev libfmt-dev libxxhash-dev"
test_packages="catch2 make clang-14 libclang-rt-14-dev python3 python3-jsonschema glslang-tools spirv-tools spirv-cross libegl1
  libgl1-mesa-dri mesa-vulkan-drivers libvulkan-dev groff parallel zsh fish slurmctld slurmd slurm-client munge"

# Words of $1 that are no installed package. All of them where there is no dpkg.
missing_packages() {
  for package in $1; do
    status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) || status=
    [ "$status" = "install ok installed" ] || printf ' %s' "$package"
  done
}

install_packages() {
  wanted=$build_packages
  if [ "$1" = test ]; then wanted="$wanted $test_packages"; fi
  missing=$(missing_packages "$wanted")
  if [ -z "$missing" ]; then return 0; fi

  as_root=
  if [ "$(id -u)" != 0 ]; then as_root=sudo; fi
  if command -v apt-get >/dev/null && command -v ${as_root:-true} >/dev/null; then
    echo "Installing$missing"
    if $as_root apt-get update -qq &&
      $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends $missing >/dev/null; then
      return 0
    fi
  fi
  cat >&2 <<END
These packages are missing (names as in Debian 12):
 $missing
As root on Debian 12, they are installed by
  apt-get install --no-install-recommends$missing
END
  return 1
}
