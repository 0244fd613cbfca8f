// SPDX-License-Identifier: BSD-3-Clause
// Conversion between frames and Eigen: `eigen(v)` for inputs of an algorithm, `from_eigen<Ned>(v)` and
// `from_eigen(q)` for its results (frames.hpp).
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fulmar/frames.hpp"
