// SPDX-License-Identifier: BSD-3-Clause
// The bridge between frames and Eigen: `eigen(v)` inside an algorithm, `from_eigen<Ned>(v)` and
// `from_eigen(q)` at its door (frames.hpp).
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fulmar/frames.hpp"
