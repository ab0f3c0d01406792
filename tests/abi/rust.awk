# SPDX-License-Identifier: MIT
# Prints v1.txt as Rust: every struct, every constant, and the headers' macros. With -v check=1 it prints a program
# that compares size and offset of each with those written down.
function rust_type(type) {
  if (type in plain) return plain[type]
  if (type ~ /\* const\*$/) return "*const " rust_type(substr(type, 1, length(type) - 7))
  if (type ~ /^const .*\*$/) return "*const " rust_type(substr(type, 7, length(type) - 7))
  if (type ~ /\*$/) return "*mut " rust_type(substr(type, 1, length(type) - 1))
  return type
}
function name_of(declaration) {
  match(declaration, /[A-Za-z0-9_]+$/)
  return substr(declaration, RSTART, RLENGTH)
}
function type_of(declaration) {
  match(declaration, /[A-Za-z0-9_]+$/)
  return rust_type(substr(declaration, 1, RSTART - 2))
}
function escaped(name) { return name == "type" ? "r#type" : name == "self" ? "self_" : name }
function function_type(declaration,   returns, count, parts, i, out) {
  match(declaration, /\(\*[a-z0-9_]+\)/)
  returns = substr(declaration, 1, RSTART - 2)
  declaration = substr(declaration, RSTART + RLENGTH + 1)
  sub(/\)$/, "", declaration)
  count = declaration == "void" ? 0 : split(declaration, parts, /, /)
  for (i = 1; i <= count; ++i) out = out (i > 1 ? ", " : "") escaped(name_of(parts[i])) ": " type_of(parts[i])
  return "Option<unsafe extern \"C\" fn(" out ")" (returns == "void" ? "" : " -> " rust_type(returns)) ">"
}
BEGIN {
  split("uint8_t u8 uint16_t u16 uint32_t u32 uint64_t u64 int32_t i32 int64_t i64 float f32 double f64 char c_char void c_void", p, " ")
  for (i = 1; i in p; i += 2) plain[p[i]] = p[i + 1]
  if (check) {
    print "mod dmrp;\nuse std::mem::{size_of, MaybeUninit};\nuse std::ptr::addr_of;\nfn main() {"
  } else {
    print "// SPDX-License-Identifier: MIT"
    print "// The plugin contract of dmrp, written from its C headers. What each thing means stands there."
    print "#![allow(non_camel_case_types, dead_code, unused_macros, unused_imports)]"
    print "use std::os::raw::{c_char, c_void};\n"
    print "/// Element `index` of an array with the owner's stride."
    print "pub unsafe fn at<'a, T>(base: *const T, stride: u32, index: usize) -> &'a T {"
    print "    &*((base as *const u8).add(index * stride as usize) as *const T)\n}\n"
    print "/// The same of an output array."
    print "pub unsafe fn at_out<'a, T>(base: *mut T, stride: u32, index: usize) -> &'a mut T {"
    print "    &mut *((base as *mut u8).add(index * stride as usize) as *mut T)\n}\n"
    print "/// Whether the struct behind `pointer` is long enough to hold `field`."
    print "macro_rules! has {\n    ($pointer:expr, $field:ident) => {{"
    print "        let start = $pointer as *const _ as usize;"
    print "        let end = std::ptr::addr_of!((*$pointer).$field).add(1) as usize;"
    print "        (*$pointer).struct_size as usize >= end - start\n    }};\n}\npub(crate) use has;\n"
    print "/// Whether array elements of `stride` bytes hold `field` of `type`."
    print "macro_rules! stride_has {\n    ($type:ty, $stride:expr, $field:ident) => {{"
    print "        let element = std::mem::MaybeUninit::<$type>::uninit();"
    print "        let end = std::ptr::addr_of!((*element.as_ptr()).$field).add(1) as usize;"
    print "        $stride as usize >= end - element.as_ptr() as usize\n    }};\n}\npub(crate) use stride_has;\n"
    printf "#[repr(C)]\npub struct dmrp_instance {\n    _opaque: [u8; 0],\n"
  }
}
/^#/ || /^$/ { next }
/^[a-z]/ {
  type = $1
  if (check)
    print "    assert_eq!(size_of::<dmrp::" type ">(), " $2 ");\n    let one = MaybeUninit::<dmrp::" type ">::uninit();\n" \
          "    let start = one.as_ptr() as usize;"
  else
    print "}\n\n#[repr(C)]\n#[derive(Clone, Copy)]\npub struct " type " {"
  next
}
/^ / {
  offset = $1
  sub(/^ +[0-9]+ [0-9]+ /, "")
  is_function = match($0, /\(\*[a-z0-9_]+\)/)
  name = escaped(is_function ? substr($0, RSTART + 2, RLENGTH - 3) : name_of($0))
  if (check)
    print "    assert_eq!(unsafe { addr_of!((*one.as_ptr())." name ") } as usize - start, " offset ");"
  else
    print "    pub " name ": " (is_function ? function_type($0) : type_of($0)) ","
  next
}
/ = / && !check {
  value = substr($0, index($0, " = ") + 3)
  kind = "i32"
  if (value ~ /^"/) {
    kind = "&[u8]"
    value = "b" substr(value, 1, length(value) - 1) "\\0\""
  } else if (sub(/u$/, "", value)) {
    kind = "u32"
  }
  gsub(/[()]/, "", value)
  constants = constants "pub const " $1 ": " kind " = " value ";\n"
}
END { printf "}\n%s", check ? "" : "\n" constants }
