// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/earth/atmosphere.hpp"

#include <doctest/doctest.h>

#include "sdk/test/flight/check_case.hpp"

namespace atmosphere_test {

using namespace fulmar;
using doctest::Approx;

TEST_CASE("the standard atmosphere agrees with the table of ISO 2533") {
  struct Row {
    double altitude, temperature, pressure, density;
  };
  for (const Row& row : {Row{-1000, 294.65, 113929.3, 1.34700}, Row{0, 288.15, 101325.0, 1.22500},
                         Row{1000, 281.65, 89874.6, 1.11164}, Row{2000, 275.15, 79495.2, 1.00649},
                         Row{5000, 255.65, 54019.9, 0.736116}, Row{11000, 216.65, 22632.1, 0.363918},
                         Row{15000, 216.65, 12044.6, 0.193673}, Row{20000, 216.65, 5474.9, 0.0880349}}) {
    const Air air = standard_air(row.altitude);
    CHECK(air.temperature_kelvin == Approx(row.temperature).epsilon(1e-6));
    CHECK(air.pressure_pa == Approx(row.pressure).epsilon(1e-5));
    CHECK(air.density_kgm3 == Approx(row.density).epsilon(1e-5));
  }
  CHECK(standard_air(0).speed_of_sound_mps() == Approx(340.294).epsilon(1e-6));
}

TEST_CASE("pressure altitude is the inverse of the standard atmosphere, above the tropopause, too") {
  for (double h : {-300.0, 0.0, 1387.0, 1457.0, 8000.0, 10999.0, 11001.0, 18000.0})
    CHECK(pressure_altitude(standard_air(h).pressure_pa) == Approx(h).epsilon(1e-9));
  // the hypsometric rule of thumb: 8.33 m per hPa at sea level, here from dp = -rho g dh
  CHECK(pressure_altitude(101325 - 100) == Approx(100 / (1.225 * 9.80665)).epsilon(1e-3));
}

TEST_CASE("the standard atmosphere agrees with NASA's check case at geopotential altitude") {
  const auto nasa = test::CheckCase::open("Atmos_01_DroppedSphere/Atmos_01_sim_05.csv");
  if (!nasa) {
    MESSAGE("skipped: the check cases are not there");
    return;
  }
  constexpr double foot = 0.3048, slug = 14.59390294, earth = 6356766;
  for (std::size_t i = 0; i < nasa->size(); i += 500) {
    const double z = nasa->at(i, "altitudeMsl_ft") * foot;
    const Air air = standard_air(earth * z / (earth + z));
    CHECK(air.density_kgm3 ==
          Approx(nasa->at(i, "airDensity_slug_ft3") * slug / (foot * foot * foot)).epsilon(2e-4));
    CHECK(air.temperature_kelvin == Approx(nasa->at(i, "ambientTemperature_dgR") / 1.8).epsilon(2e-4));
    CHECK(air.speed_of_sound_mps() == Approx(nasa->at(i, "speedOfSound_ft_s") * foot).epsilon(2e-4));
  }
}

TEST_CASE(
    "on another day the air is in hydrostatic equilibrium with the temperature and pressure of that day") {
  CHECK(standard_air(0, {20, 0}).density_kgm3 == Approx(1.1455).epsilon(1e-4));   // 35 degrees Celsius
  CHECK(standard_air(0, {-35, 0}).density_kgm3 == Approx(1.3944).epsilon(1e-4));  // -20 degrees
  for (const AirOffset& day : {AirOffset{25, -1500}, AirOffset{-30, 2500}, AirOffset{}})
    for (const double h : {0.0, 3000.0, 10900.0, 11100.0, 16000.0}) {
      const Air low = standard_air(h - 5, day), here = standard_air(h, day), high = standard_air(h + 5, day);
      CHECK((high.pressure_pa - low.pressure_pa) / 10 == Approx(-9.80665 * here.density_kgm3).epsilon(1e-6));
      CHECK(here.temperature_kelvin == Approx(standard_air(h).temperature_kelvin + day.temperature_kelvin));
    }
  for (const double pressure : {-3000.0, 3000.0})
    CHECK(standard_air(0, {0, pressure}).pressure_pa == Approx(101325 + pressure));
  for (const double h : {0.0, 1457.0, 12000.0})  // no offset: the standard day, to the bit
    CHECK(standard_air(h, {0, 0}).density_kgm3 == standard_air(h).density_kgm3);
}

TEST_CASE("geopotential altitudes are those of the table of the U.S. Standard Atmosphere 1976") {
  for (const auto& [geometric, geopotential] :
       {std::pair{-5000.0, -5004.0}, {0.0, 0.0}, {5000.0, 4996.0}, {11019.0, 11000.0}, {20063.0, 20000.0}})
    CHECK(std::abs(geopotential_altitude(geometric) - geopotential) < 0.6);
}

TEST_CASE("indicated airspeed is that of the pressure at sea level, true airspeed that at this density") {
  const double rho = standard_air(1387).density_kgm3, Va = 17;
  const double indicated = indicated_airspeed(0.5 * rho * Va * Va);
  CHECK(indicated == Approx(Va * std::sqrt(rho / 1.225)));
  CHECK(indicated == Approx(15.89).epsilon(1e-3));
  CHECK(true_airspeed(indicated, rho) == Approx(Va));
  CHECK(indicated_airspeed(-10) == Approx(-indicated_airspeed(10)));
}

TEST_CASE("the density nearby is that of the altitude within 1e-4, wherever the aircraft goes") {
  NearbyDensity density;
  double worst = 0;
  for (double altitude = 0, step = 0.013; altitude < 3000; altitude += step *= 1.001)
    worst = std::max(worst, std::abs(density.at(altitude) / standard_air(altitude).density_kgm3 - 1));
  for (const double altitude : {2990.0, 10.0, 9.5, 4000.0, 10.0})
    worst = std::max(worst, std::abs(density.at(altitude) / standard_air(altitude).density_kgm3 - 1));
  CHECK(worst < 1.1e-4);
  CHECK(worst > 1e-6);  // not recomputed at each step
}

}  // namespace atmosphere_test
