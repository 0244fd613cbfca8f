// SPDX-License-Identifier: BSD-3-Clause
// What must not compile, one case per number. CASE 0 is the control: all of it without the fault compiles.
#include <vector>

#if CASE == 3
#include "fulmar/eigen.hpp"
#endif
#include "fulmar/plugin.hpp"

using namespace fulmar;

struct Good {
  double speed_mps = 0;
  Vec3<Ned> position_m;
};

#if CASE == 1
struct Bad {
  double speed = 0;
};
#elif CASE == 2
struct Bad {
  Vec3<Body> rate;
};
#elif CASE == 3
struct Bad {
  Eigen::Vector3d position_m;
};
#elif CASE == 4
struct Bad {
  const char* name;
};
#elif CASE == 5
struct Bad {
  std::vector<double> x_m;
};
#elif CASE == 6
struct Bad : Good {
  double more_m = 0;
};
#elif CASE == 7
enum class Wide : int { a };
struct Bad {
  Wide wide;
};
#elif CASE == 8
struct Bad {
  double gain_m[3];
};
#elif CASE == 9
struct Bad {
  int* counter_ns;
};
#else
struct Bad {
  double speed_mps = 0;
};
#endif
static_assert(describe<Bad>().size == sizeof(Bad));

inline Vec3<Ned> add(const Vec3<Ned>& a, const Vec3<Ned>& b) { return a + b; }
#if CASE == 10
inline auto mixed(const Vec3<Ned>& a, const Vec3<Body>& b) { return a + b; }
#endif
#if CASE == 11
inline Vec3<Body> confused(const Vec3<Ned>& a) { return a; }
#endif

struct Component {
  struct Inputs {
#if CASE == 12
    Good good;
#else
    In<Good> good;
#endif
  };
  struct Outputs {
    Good out;
#if CASE == 13
    Probe roll_error;
#else
    Probe roll_error_rad;
#endif
#if CASE == 14
    In<Good> wrong;
#endif
  };
  struct Params {};
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
};
FULMAR_PLUGIN("1.0.0", Component)
