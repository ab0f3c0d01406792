// SPDX-License-Identifier: MIT
#pragma once

#include <nav2_shim/node.hpp>
