# SPDX-License-Identifier: MIT
# Prints dmrp-abi.json as Rust: every struct, every constant, and the headers' macros. With -v check=1 it prints a
# program that compares size and offset of each with those written down. json.awk writes a field or a constant a line.

# The value of a key in a line: a number, or a text with its escapes.
function member(key, line) {
  if (!match(line, "\"" key "\": ")) return ""
  line = substr(line, RSTART + RLENGTH)
  if (line !~ /^"/) {
    sub(/[,}].*/, "", line)
    return line
  }
  match(line, /^"([^"\\]|\\.)*"/)
  return substr(line, 2, RLENGTH - 2)
}
function documented(indent, line,   comment) {
  comment = member("comment", line)
  gsub(/\\n/, "\n" indent "/// ", comment)
  gsub(/\\"/, "\"", comment)
  return comment == "" ? "" : indent "/// " comment "\n"
}
function rust_type(type) {
  if (type in plain) return plain[type]
  if (type ~ /\* const\*$/) return "*const " rust_type(substr(type, 1, length(type) - 7))
  if (type ~ /^const .*\*$/) return "*const " rust_type(substr(type, 7, length(type) - 7))
  if (type ~ /\*$/) return "*mut " rust_type(substr(type, 1, length(type) - 1))
  return type
}
function escaped(name) { return name == "type" ? "r#type" : name == "self" ? "self_" : name }
function function_type(line,   returns, count, parts, i, out) {
  returns = member("returns", line)
  match(line, /"arguments": \[[^\]]*\]/)
  line = substr(line, RSTART, RLENGTH)
  count = split(line, parts, /\}/) - 1
  for (i = 1; i <= count; ++i)
    out = out (i > 1 ? ", " : "") escaped(member("name", parts[i])) ": " rust_type(member("type", parts[i]))
  return "Option<unsafe extern \"C\" fn(" out ")" (returns == "void" ? "" : " -> " rust_type(returns)) ">"
}
BEGIN {
  split("uint8_t u8 uint16_t u16 uint32_t u32 uint64_t u64 int32_t i32 int64_t i64 float f32 double f64 char c_char void c_void", p, " ")
  for (i = 1; i in p; i += 2) plain[p[i]] = p[i + 1]
  if (check) {
    print "mod dmrp;\nuse std::mem::{size_of, MaybeUninit};\nuse std::ptr::addr_of;\nfn main() {"
  } else {
    print "// SPDX-License-Identifier: MIT"
    print "// The plugin contract of dmrp, written from its C headers."
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
/^    \{"name": .*"fields": \[/ {
  type = member("name", $0)
  if (check)
    print "    assert_eq!(size_of::<dmrp::" type ">(), " member("size", $0) ");"
  else
    print "}\n\n" documented("", $0) "#[repr(C)]\n#[derive(Clone, Copy)]\npub struct " type " {"
  next
}
/^      \{"offset": / {
  name = escaped(member("name", $0))
  if (check) {
    print "    let one = MaybeUninit::<dmrp::" type ">::uninit();"
    print "    let start = one.as_ptr() as usize;"
    print "    assert_eq!(unsafe { addr_of!((*one.as_ptr())." name ") } as usize - start, " member("offset", $0) ");"
  } else {
    printf "%s", documented("    ", $0)
    print "    pub " name ": " (member("type", $0) == "function" ? function_type($0) : rust_type(member("type", $0))) ","
  }
  next
}
/^    "DMRP_[A-Z0-9_]*": / && !check {
  split($0, quoted, "\"")
  type = member("type", $0)
  value = member("value", $0)
  if (type == "text") value = "b\"" value "\\0\""
  constants = constants documented("", $0) "pub const " quoted[2] ": " \
              (type == "text" ? "&[u8]" : rust_type(type)) " = " value ";\n"
}
END { printf "}\n%s", check ? "" : "\n" constants }
