// SPDX-License-Identifier: BSD-3-Clause
// Compile errors, one case per number. CASE 0 is the control: everything without an error compiles.
#include <string>
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
#elif CASE == 22
struct Bad {
  double length_m = 0;
  std::string name;
};
#elif CASE == 23
struct Bad {
  std::array<std::array<double, 3>, 2> gains_ratio{};
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
#if CASE == 15
inline double far(const Vec3<Ned>& v) { return eigen(v).norm(); }
#elif CASE == 16  // an author who includes Eigen, even after the SDK, needs nothing else
#include <Eigen/Dense>
inline double far(const Vec3<Ned>& v, const Quat& q) {
  const Eigen::Vector3d turned = eigen(q) * eigen(v);
  return from_eigen<Body>(turned + turned).x + from_eigen(eigen(q).conjugate()).w;
}
#endif
#if CASE == 17
struct Wide {  // one member too many
  double a0_m, a1_m, a2_m, a3_m, a4_m, a5_m, a6_m, a7_m, a8_m, a9_m, b0_m, b1_m, b2_m, b3_m, b4_m, b5_m, b6_m,
      b7_m, b8_m, b9_m, c0_m, c1_m, c2_m, c3_m, c4_m, c5_m, c6_m, c7_m, c8_m, c9_m, d0_m, d1_m, d2_m, d3_m,
      d4_m, d5_m, d6_m, d7_m, d8_m, d9_m, e0_m, e1_m, e2_m, e3_m, e4_m, e5_m, e6_m, e7_m, e8_m, e9_m, f0_m,
      f1_m, f2_m, f3_m, f4_m, f5_m, f6_m, f7_m, f8_m, f9_m, g0_m, g1_m, g2_m, g3_m, g4_m;
};
static_assert(describe<Wide>().size == sizeof(Wide));
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
#if CASE == 18
  struct Params {
    double gain = 1;
  };
#elif CASE == 20
  struct Lateral {
    Param gain{1, "", 0, 1, "of roll"};
  };
  struct Vertical {
    Param gain{1, "", 0, 1, "of pitch"};
  };
  struct Params {
    Lateral lateral;
    Vertical vertical;
  };
#elif CASE == 21
  struct Lateral {
    Param gain{1, "", 0, 1, "of roll"};
    const char* note = "";
  };
  struct Params {
    Lateral lateral;
  };
#elif CASE == 24
  struct Params {
    Param gain{1, "", 0, 1, "of roll"};
    std::string name = "roll";
  };
#elif CASE == 25
  struct Params {
    std::array<double, 4> gains{};
  };
#else
  struct Params {};
#endif
#if CASE == 26
  void configure() {}
#elif CASE == 27
  void configure(Params&) {}
#elif CASE == 28
  void retune(const Tick&, const Params&) {}
#elif CASE == 29
  Status activate(const Tick&, const Inputs&, const Params&) { return Status::ok; }
#endif
#if CASE == 19
  Status activate(const Tick&, const Inputs&, const Params&, const Applied<Outputs>& last) {
    return last.has(last->roll_error_rad.value) ? Status::ok : Status::failed;
  }
#endif
#if CASE == 30
  Status stp(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
#elif CASE == 31
  Status step(const Tick&, const Inputs&, Outputs&) { return Status::ok; }
#elif CASE == 32
  void step(const Tick&, const Inputs&, const Params&, Outputs&) {}
#elif CASE == 33
  Status read(Tick&, const Params&, Outputs&) { return Status::ok; }
#else
  Status step(const Tick&, const Inputs&, const Params&, Outputs&) { return Status::ok; }
#endif
};
#if CASE == 34
namespace other {
struct Component : ::Component {};
}  // namespace other
FULMAR_PLUGIN("1.0.0", Component, other::Component)
#else
FULMAR_PLUGIN("1.0.0", Component)
#endif
