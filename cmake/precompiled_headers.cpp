// SPDX-License-Identifier: MIT
// A set of precompiled headers needs a source: this one. CMake includes the headers.
