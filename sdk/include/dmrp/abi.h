/* SPDX-License-Identifier: MIT */
// abi.h: version numbers, the rules of the ABI, and the macros that express them.
//
// The rules apply to all headers:
//
// - Only fixed-width integers, double, float arrays, pointers and text cross the ABI. 64-bit, little-endian. Text is
//   NUL-terminated UTF-8; NULL means "".
// - *Values* (values.h) are frozen: they have no struct_size and never get another field.
// - *Growable structs* begin with `uint32_t struct_size`, cross by pointer only and have no implicit padding.
//   New fields are appended. The maker of a struct sets struct_size to the sizeof it was compiled with; the reader
//   checks DMRP_HAS(pointer, field) for every field newer than v1.0. Every appended field names its absent value, which
//   a reader takes where the maker's struct does not have it, and which the host fills in where it passes on what an
//   older plugin made. In what a plugin makes or fills in, the absent value is zero.
// - *Array elements* cross as pointer, count and the owner's stride in bytes; access them with DMRP_AT, never with [].
//   Elements grow like growable structs: the stride tells which fields exist (DMRP_STRIDE_HAS). Only the contract
//   appends fields: what a plugin appends for itself is not passed on. Strides are multiples of 8. A pointer to a single
//   element has its stride too, unless it points into an array that has one.
// - Appended fields stand in `#if DMRP_TARGET_MINOR >= N`. A plugin that a host 1.0 shall load is compiled with
//   DMRP_TARGET_MINOR 0, sees the structs of 1.0 alone, and so may copy whole elements.
// - *Output structs* are allocated, zeroed and sized by the caller; the callee never writes past struct_size, nor past
//   the stride of an output array (DMRP_AT_OUT). Nothing that may grow is embedded in another struct.
// - `reserved` fields are zero: a later minor version may give them a meaning in which zero is as before. A reader ignores
//   them in what the host hands out; the host refuses what a plugin hands in with one of them set.
// - *Constants* are open lists unless a header says otherwise: a minor version may add to them, so readers skip, or
//   treat as the header says, what they do not know.
// - Pointers are not NULL, and functions in a table are there, unless a header says that they may be NULL.
// - Pointers in a struct that the host passes are valid until the call returns, unless the header says otherwise:
//   a dmrp_host is valid until destroy() returns (the library's own until deinit() returns); dmrp_world and extensions
//   are valid until the next start() or destroy() begins, and neither of these two may access them.
// - No exception and no longjmp crosses the ABI: host functions never throw, a plugin catches what it throws. A plugin
//   does not end the process, and does not fork unless its descriptor has DMRP_FLAG_PROCESSES.
// - Every function carries a thread tag:
//     [main]  on the main thread of its process, no other call into the library at the same time
//     [step]  inside a trial: one call at a time for an instance; instances may run concurrently and may move
//             between threads from call to call
//     [any]   at any time, from any thread
// - Results depend on the arguments, the parameters and the seed of start() alone: not on clocks, addresses,
//   hash order, earlier trials, or other instances in the process.
// - A plugin does not change the locale, working directory, signal handlers, environment, floating-point control bits
//   or file descriptors that it did not open, and starts no thread in a static initialiser.
//
// What may change: a minor version appends fields, functions at the end of a table, constants and extensions, and takes
// nothing away; a plugin built with 1.x runs on every host 1.y with y >= its min_host_minor. Only a major version changes
// the rest. The C++ layer (cpp/) and the toolkit are compiled into the plugin and are no part of this binary promise.
// Their source promise: code that compiles with the C++ layer of 1.x compiles with that of 1.y, y > x; the toolkit may
// change with every release, and CHANGELOG.md says how.
#ifndef DMRP_ABI_H
#define DMRP_ABI_H

#include <stddef.h>
#include <stdint.h>

// The major version is part of the name of the exported symbol (dmrp_entry_v1).
#define DMRP_ABI_MAJOR 1
#define DMRP_ABI_MINOR 0

// Until v1 is frozen the contract may change, so host and plugin must have the same draft number.
// It becomes zero with the freeze.
#define DMRP_ABI_DRAFT 5

// The lowest minor version of the host that a plugin asks for: it sees no later field, and entry.min_host_minor is this.
#ifndef DMRP_TARGET_MINOR
#define DMRP_TARGET_MINOR DMRP_ABI_MINOR
#endif

// Whether the struct behind `pointer` is long enough to hold `field`.
#define DMRP_HAS(pointer, field)     \
  ((size_t)(pointer)->struct_size >= \
   (size_t)((const char*)&(pointer)->field - (const char*)(pointer)) + sizeof((pointer)->field))

// Whether array elements of `stride` bytes hold `field` of `type`.
#define DMRP_STRIDE_HAS(type, stride, field) ((size_t)(stride) >= offsetof(type, field) + sizeof(((type*)0)->field))

// Element `index` of an array of `type` with the owner's stride.
#define DMRP_AT(type, base, stride, index) \
  ((const type*)(const void*)((const char*)(base) + (size_t)(index) * (size_t)(stride)))

// The same for an output array: a pointer to write to.
#define DMRP_AT_OUT(type, base, stride, index) ((type*)(void*)((char*)(base) + (size_t)(index) * (size_t)(stride)))

// Whatever visibility a plugin library is compiled with: marks its exported object, and the variables of the C++ layer
// and the toolkit, each library's own (gcc otherwise makes an inline variable one object for the process).
#if defined(_MSC_VER)
#define DMRP_EXPORT __declspec(dllexport)
#define DMRP_LOCAL
#else
#define DMRP_EXPORT __attribute__((visibility("default")))
#define DMRP_LOCAL __attribute__((visibility("hidden")))
#endif

#if defined(__cplusplus)
#define DMRP_STATIC_ASSERT(condition, name) static_assert(condition, #name)
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define DMRP_STATIC_ASSERT(condition, name) _Static_assert(condition, #name)
#else
#define DMRP_STATIC_ASSERT(condition, name) typedef char dmrp_assert_##name[(condition) ? 1 : -1]
#endif

#define DMRP_NOBODY 0xFFFFFFFFu  // an index that is no robot's

// Asserts that a struct has no padding: its size is the sum of its fields. Compilation fails where a compiler pads.
#define DMRP_ASSERT_SIZE(type, bytes) DMRP_STATIC_ASSERT(sizeof(type) == (bytes), size_of_##type)

DMRP_STATIC_ASSERT(sizeof(void*) == 8 && sizeof(double) == 8, dmrp_needs_a_64_bit_platform);

#endif
