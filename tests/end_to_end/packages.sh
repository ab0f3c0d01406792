#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Debian packages, unpacked into an empty folder: what they depend on, the quickstart, and plugins of each kind,
# written, built, tested and run from there. Called as: packages.sh DMRP_HOST CMAKE
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
build_dir=$(dirname "$(dirname "$host")") cmake=$2
for tool in dpkg-deb dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool" && exit 77; }
done
cd "$scratch" || exit 1

expect_status 0 "${cmake%cmake}cpack" --config "$build_dir/CPackConfig.cmake" -B "$scratch/made"
mkdir debs root && mv made/*.deb debs
[[ $(cd debs && echo *.deb) =~ ^dmrp-doc_.*_all.deb\ dmrp-host_.*\ dmrp-plugins_.*\ dmrp-sdk-dev_.*_all.deb\ python3-dmrp_.*_all.deb$ ]] ||
  fail "there should be five packages: $(ls debs)"
depends=$(dpkg-deb -f debs/dmrp-host_*.deb Depends)
for library in libc6 libstdc++6 libfmt9 libsqlite3-0 libseccomp2 libssl3 libyaml-cpp0.7; do
  [[ $depends == *"$library "* ]] || fail "dmrp-host should depend on $library: $depends"
done
depends=$(dpkg-deb -f debs/dmrp-plugins_*.deb Depends)
[[ $depends == *libstdc++6* && $depends != *libfmt* ]] || fail "built-in plugins need the C++ library alone: $depends"

doubles=$(for package in debs/*.deb; do dpkg-deb -c "$package" | grep -v '/$' | awk '{print $6}'; done | sort | uniq -d)
[[ -z $doubles ]] || fail "two packages cannot have the same file: $doubles"
for package in debs/*.deb; do
  dpkg-deb -x "$package" root || fail "cannot unpack $package"
  name=$(dpkg-deb -f "$package" Package)
  [[ -s root/usr/share/doc/$name/copyright ]] || fail "$name has no copyright"
done
for file in share/man/man1/dmrp-host.1 share/bash-completion/completions/dmrp-host \
  share/zsh/vendor-completions/_dmrp-host share/doc/dmrp/README.md share/doc/dmrp/docs/plugins.md \
  share/dmrp/examples/quickstart.toml share/dmrp/examples/nav2/CMakeLists.txt \
  share/dmrp/examples/nav2/adapter/controller.cpp share/dmrp/examples/python_controller/policy.py \
  share/dmrp/examples/other_languages/planner.c share/pkgconfig/dmrp.pc include/dmrp/plugin.hpp; do
  compgen -G "root/usr/$file*" >/dev/null || fail "no package has $file"
done
! grep -rqF "$build_dir" root || fail "packages know where they were made: $(grep -rlF "$build_dir" root)"

# nothing of this machine's dmrp: the program finds plugins, worlds and the page relative to its own place
mkdir empty && cd empty || exit 1
unset DMRP_SCENARIO_PATH DMRP_PLUGIN_PATH
expect_status 0 ../root/usr/bin/dmrp-host ../root/usr/share/dmrp/examples/quickstart.toml
grep -q "12 of 12 robots arrived" "$scratch/stdout" || fail "the quickstart says $(cat "$scratch/stdout")"
grep -q "<title>" runs/quickstart/report.html || fail "the quickstart should have a report"

if /usr/bin/python3 -c 'import pandas' 2>/dev/null; then
  [[ $(dpkg-deb -f ../debs/python3-dmrp_*.deb Depends) == *dmrp-host*python3-pandas* ]] || fail "python3-dmrp depends on too little"
  means='print(dmrp.load("runs/quickstart").summary(metrics=["success"])["mean"].tolist())'
  PATH=$scratch/root/usr/bin:$PATH PYTHONPATH=$scratch/root/usr/lib/python3/dist-packages \
    expect_status 0 /usr/bin/python3 -c "import dmrp; $means"
  [[ $(cat "$scratch/stdout") == "[1.0]" ]] || fail "python3-dmrp reads $(cat "$scratch/stdout")"
fi

for kind in planner controller pedestrian-model metric; do
  expect_status 0 ../root/usr/bin/dmrp-host new "$kind" --id org.example.mine "$kind"
  # what its CI runs, once the packages are installed
  sed -n 's/^ *- run: //p' "$kind/.github/workflows/ci.yml" | grep -v apt-get >commands
  (($(wc -l <commands) == 3)) || fail "$kind: the CI file should configure, build and test: $(cat commands)"
  (cd "$kind" && CMAKE_PREFIX_PATH=$scratch/root/usr expect_status 0 bash -e ../commands) || exit 1
  grep -q "DMRP_HOST:FILEPATH=$scratch/root/usr/bin/dmrp-host" "$kind/build/CMakeCache.txt" ||
    fail "$kind: the package should find the program beside it"
done
