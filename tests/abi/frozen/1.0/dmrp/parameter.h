/* SPDX-License-Identifier: MIT */
// parameter.h: the parameters that a plugin declares, and the values that the host passes to create().
//
// The host checks an experiment file against the declared table before it creates any instance: unknown keys,
// wrong types and values out of range never reach a plugin. create() gets the *complete* table, defaults filled in.
#ifndef DMRP_PARAMETER_H
#define DMRP_PARAMETER_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Types of a parameter. PATH is a path that the host resolves against the folder of the experiment file; the manifest
// lists the file's hash. Open list: a host skips a plugin with a parameter of a type that it does not know, and says so.
#define DMRP_PARAM_BOOL 1u          // integer 0 or 1
#define DMRP_PARAM_INT 2u           // integer
#define DMRP_PARAM_DOUBLE 3u        // number
#define DMRP_PARAM_STRING 4u        // text
#define DMRP_PARAM_CHOICE 5u        // text, one of spec.choices
#define DMRP_PARAM_PATH 6u          // text
#define DMRP_PARAM_DOUBLE_ARRAY 7u  // numbers, count
#define DMRP_PARAM_STRING_ARRAY 8u  // texts, count

// One value. Only the field of its type is meaningful; the others are zero. Array element.
// Valid until create() returns.
typedef struct dmrp_param_value {
  const char* key;
  uint32_t type;   // DMRP_PARAM_*
  uint32_t count;  // of an array, 0 otherwise
  int64_t integer;
  double number;
  const char* text;
  const double* numbers;
  const char* const* texts;
} dmrp_param_value;

// The table passed to create(): exactly the declared keys, in the declared order.
typedef struct dmrp_params {
  uint32_t struct_size;
  uint32_t count;
  uint32_t stride;  // of values
  uint32_t reserved;
  const dmrp_param_value* values;
} dmrp_params;

// One declared parameter. Static data of the plugin. Array element.
typedef struct dmrp_param_spec {
  const char* key;  // letters, digits and '_', unique within the plugin
  uint32_t type;    // DMRP_PARAM_*
  uint32_t count;   // of the default of an array
  // The default: the field of the type.
  int64_t integer;
  double number;
  const char* text;
  const double* numbers;
  const char* const* texts;
  const char* unit;  // "m", "rad/s", "1" for a ratio, "" if there is none
  const char* doc;   // one line
  // Of INT, DOUBLE and each element of DOUBLE_ARRAY: the default lies within. No bound is -INFINITY or INFINITY;
  // minimum = maximum = 0, as in a struct that was not filled in, is refused.
  double minimum;
  double maximum;
  const char* const* choices;  // for CHOICE, choice_count texts; the default is one of them
  uint32_t choice_count;
  uint32_t reserved;
} dmrp_param_spec;

DMRP_ASSERT_SIZE(dmrp_param_value, 56);
DMRP_ASSERT_SIZE(dmrp_params, 24);
DMRP_ASSERT_SIZE(dmrp_param_spec, 104);

#ifdef __cplusplus
}
#endif

#endif
