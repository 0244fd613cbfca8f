// SPDX-License-Identifier: BSD-3-Clause
// Passes 200 bytes on: the cost of a port alone.
#include "fulmar/plugin.hpp"

using namespace fulmar;

namespace {

struct Block {
  std::array<double, 25> x_m{};
};

struct Begin {
  struct Inputs {};
  struct Outputs {
    Block block;
  };
  struct Params {};
  Status step(const Tick& tick, const Inputs&, const Params&, Outputs& out) {
    out.block.x_m[0] = tick.now_s();
    return Status::ok;
  }
};

struct Hop {
  struct Inputs {
    In<Block> block;
  };
  struct Outputs {
    Block block;
  };
  struct Params {};
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
    out.block = *in.block;
    return Status::ok;
  }
};

}  // namespace

FULMAR_PLUGIN("1.0.0", Begin, Hop)
