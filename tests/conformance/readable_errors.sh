#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A mistake in a plugin class that the compiler can find is its first error, in one readable line, and gcc gives no other.
# Called as: readable_errors.sh INCLUDE_DIR
set -euo pipefail
include=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# errors_of COMPILER MEMBER...: the errors for a controller with these members
errors_of() {
  local compiler=$1
  shift
  {
    cat <<'END'
namespace {
struct other_extension {
  int number;
};
class Mine final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.mine", "Mine", "0.1.0"); }
  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation&, dmrp::Command&) override { return dmrp::Status::ok; }
END
    printf '  %s\n' "$@"
    printf '};\n}\nDMRP_PLUGINS(Mine)\n'
  } >"$scratch/mine.cpp"
  "$compiler" -std=c++17 -fsyntax-only -include "$scratch/$compiler/layer.hpp" "$scratch/mine.cpp" 2>&1 | grep -E '(^|: )(fatal )?error: ' || true
}

compilers=(g++)
! command -v clang++ >/dev/null || compilers+=(clang++)
for compiler in "${compilers[@]}"; do
  mkdir "$scratch/$compiler"
  echo '#include <dmrp/plugin.hpp>' >"$scratch/$compiler/layer.hpp"
  "$compiler" -std=c++17 -I "$include" -x c++-header "$scratch/$compiler/layer.hpp" -o "$scratch/$compiler/layer.hpp.gch"
done

expect_error() {
  local text=$1 compiler errors
  shift
  for compiler in "${compilers[@]}"; do
    errors=$(errors_of "$compiler" "$@")
    if [[ ${errors%%$'\n'*} != *"$text"* ]] || [[ $compiler == g++ && $errors == *$'\n'* ]]; then
      echo "FAILED: $compiler for '$*' should say '$text', says:"
      echo "$errors"
      failures=$((failures + 1))
    fi
  done
}

expect_no_error() {
  local compiler errors
  for compiler in "${compilers[@]}"; do
    errors=$(errors_of "$compiler" "$@")
    [[ -z $errors ]] || { echo "FAILED: $compiler refuses '$*': $errors" && failures=$((failures + 1)); }
  done
}

expect_no_error 'dmrp::Param<int> a = param("a", 1);' 'dmrp::Param<double> b = param("b", 1);' \
  'dmrp::Param<std::int64_t> c = param("c", 1);' 'dmrp::Param<std::string> d = param("d", "x").choices({"x", "y"});' \
  'static void load(const dmrp::Host&) {}' 'static void unload() {}'
# names of a plugin's own, which the layer uses too
expect_no_error 'dmrp::Param<std::string> kind = param("kind", "x");' 'dmrp::Param<int> flags = param("flags", 1);' \
  'dmrp::Param<bool> load = param("load", true);' 'void unload(int) {}'

other_type='the default given to param() is of another type than T'
for mistake in '<int> a = param("a", 0.5)' '<std::string> a = param("a", 0.5)' '<bool> a = param("a", 1)' \
  '<double> a = param("a", "x")' '<std::vector<double>> a = param("a", 1.0)'; do
  expect_error "$other_type" "dmrp::Param$mistake;"
done
type_list='T is bool, int, std::int64_t, double, std::string, std::vector<double> or std::vector<std::string>'
expect_error "$type_list" 'dmrp::Param<float> a = param("a", 0.5);'
expect_error "$type_list" 'dmrp::Param<unsigned> a = param("a", 1);'
expect_error 'choices() is for a parameter that is a text' 'dmrp::Param<int> a = param("a", 1).choices({"x"});'
expect_error 'path() is for a parameter that is a text' 'dmrp::Param<double> a = param("a", 0.5).path();'
expect_error 'this extension has no id: specialise dmrp::ExtensionId for it' \
  'dmrp::Status start(const dmrp::Start&) override {' 'return find_extension<other_extension>() ? dmrp::Status::ok' \
  ': dmrp::Status::error; }'
expect_error 'load() of a plugin class takes a const dmrp::Host&' 'static void load() {}'

((failures == 0)) || exit 1
echo "${compilers[*]}: each mistake in one line"
