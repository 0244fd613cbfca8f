// SPDX-License-Identifier: BSD-3-Clause
// The headers that most tests include, compiled once. A test still includes what it uses: ./check --long
// compiles each file alone and without this one.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>
