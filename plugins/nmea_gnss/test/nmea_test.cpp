// SPDX-License-Identifier: BSD-3-Clause
// Sentences against the examples of public descriptions (protocol manuals of u-blox and Trimble; the usual
// Munich example), and against numbers computed by hand from them.
#include "plugins/nmea_gnss/nmea.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "plugins/nmea_gnss/epochs.hpp"
#include "sentences.hpp"

namespace nmea_test {

using namespace fulmar;
using namespace fulmar::nmea;

namespace {

/// The last sentence in a text, if any.
const Sentence* read(Lines& lines, const std::string& text) {
  const Sentence* found = nullptr;
  for (const char c : text) {
    if (const Sentence* s = lines.push(c)) found = s;
  }
  return found;
}

std::vector<Gnss> samples(Epochs& epochs, const std::string& text) {
  Lines lines;
  std::vector<Gnss> all;
  for (const char c : text) {
    if (const Sentence* s = lines.push(c)) epochs.take(*s, [&](const Gnss& g) { all.push_back(g); });
  }
  return all;
}

}  // namespace

TEST_CASE("a published GGA sentence gives the position that its text says") {
  Lines lines;
  const Sentence* s = read(lines, "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n");
  REQUIRE(s);
  CHECK(s->type() == "GGA");
  const auto r = gga(*s);
  REQUIRE(r);
  CHECK(*r->time_ns == (12 * 3600 + 35 * 60 + 19) * 1000000000LL);
  CHECK(*r->latitude_deg == doctest::Approx(48.1173).epsilon(1e-12));  // 48 + 7.038 / 60
  CHECK(*r->longitude_deg == doctest::Approx(11.516666666667).epsilon(1e-12));
  CHECK(*r->altitude_m == 545.4);
  CHECK(*r->hdop == 0.9);
  CHECK(r->quality == 1);
  CHECK(r->satellites == 8);
}

TEST_CASE("published RMC, VTG, GSA and GST sentences give what their text says, in SI units") {
  Lines lines;
  const auto munich =
      rmc(*read(lines, "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\r\n"));
  REQUIRE(munich);
  CHECK(munich->valid);
  CHECK(*munich->speed_mps == doctest::Approx(11.5235556));   // 22.4 kt
  CHECK(*munich->course_rad == doctest::Approx(1.47305789));  // 84.4 deg
  CHECK((*munich->date_ns + *munich->time_ns) / 1000000000 ==
        764426119);  // date -d '1994-03-23 12:35:19 UTC' +%s
  const auto ublox =
      rmc(*read(lines, "$GPRMC,083559.00,A,4717.11437,N,00833.91522,E,0.004,77.52,091202,,,A*57\r\n"));
  CHECK((*ublox->date_ns + *ublox->time_ns) / 1000000000 == 1039422959);  // 2002-12-09 08:35:59

  const auto v = vtg(*read(lines, "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48\r\n"));
  CHECK(*v->speed_mps == doctest::Approx(2.82944444));
  CHECK(*v->course_rad == doctest::Approx(0.95469510));
  const auto a = gsa(*read(lines, "$GPGSA,A,3,04,05,,09,12,,,24,,,,,2.5,1.3,2.1*39\r\n"));
  CHECK(a->mode == 3);
  CHECK(*a->vdop == 2.1);
  const auto g = gst(*read(lines, "$GPGST,172814.0,0.006,0.023,0.020,273.6,0.023,0.020,0.031*6A\r\n"));
  CHECK(*g->latitude_m == 0.023);
  CHECK(*g->longitude_m == 0.020);
  CHECK(*g->altitude_m == 0.031);
  CHECK(lines.good() == 5);
  CHECK(lines.bad() == 0);
}

TEST_CASE("south and west are negative, and a third digit of longitude counts") {
  CHECK(*angle("3352.128", "S", 'N', 'S', 90) == doctest::Approx(-33.8688));
  CHECK(*angle("15112.558", "W", 'E', 'W', 180) == doctest::Approx(-151.2093));
  CHECK_FALSE(angle("4860.000", "N", 'N', 'S', 90));  // sixty minutes
  CHECK_FALSE(angle("9000.001", "N", 'N', 'S', 90));  // beyond the pole
  CHECK_FALSE(angle("4807.038", "E", 'N', 'S', 90));
}

TEST_CASE("dates follow the calendar, leap years included") {
  const auto days = [](const char* text) {
    return date(text).value_or(-1) / 1000000000 / 86400;
  };  // date -u -d 2024-02-29 +%s, / 86400
  CHECK(days("060180") == 3657);
  CHECK(days("311299") == 10956);
  CHECK(days("010100") == 10957);
  CHECK(days("290224") == 19782);
  CHECK(days("010324") == 19783);
  CHECK(days("311279") == 40176);
  for (const char* wrong : {"290223", "310424", "000124", "010024", "011324", "1124", "0101245", "ab0124"})
    CHECK_FALSE(date(wrong));
}

TEST_CASE(
    "a wrong checksum, a missing one, a cut line, a foreign byte and a flood without an end give nothing, "
    "and are counted") {
  Lines lines;
  const std::string good = "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48\r\n";
  CHECK_FALSE(read(lines, "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*49\r\n"));
  CHECK_FALSE(read(lines, "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K\r\n"));
  CHECK_FALSE(read(lines, "$GPVTG,054.7,T,034.4,\x80,005.5,N,010.2,K*48\r\n"));
  CHECK_FALSE(read(lines, "$" + std::string(10000, '7') + "\r\n"));
  CHECK_FALSE(read(lines, "$GPGGA*\r\n$*\r\n"));
  CHECK(lines.bad() == 6);
  CHECK(lines.good() == 0);
  const Sentence* s = read(lines, "$GPGGA,1235" + good);  // cut by the next one
  REQUIRE(s);
  CHECK(s->type() == "VTG");
  CHECK(lines.bad() == 7);
}

TEST_CASE("receivers of all systems are read; other talkers and other sentences are passed over") {
  const std::string tail = "GGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,";
  for (const char* talker : {"GP", "GN", "GL", "GA", "GB", "BD"}) {
    Lines lines;
    CHECK(read(lines, framed(talker + tail))->type() == "GGA");
  }
  Lines lines;
  CHECK(read(lines, framed("SD" + tail))->type() == "");
  CHECK(read(lines, framed("PUBX,00,081350.00"))->type() == "");
}

TEST_CASE("an epoch becomes one sample, with position, velocity, time and deviations of its sentences") {
  Epochs epochs(3);
  const std::string gst_text = framed("GNGST,120001.00,1.8,,,,1.7,1.3,2.2");
  auto all = samples(epochs,
                     epoch_text(0) + framed("GNGST,120000.00,1.8,,,,1.7,1.3,2.2") + epoch_text(1) + gst_text);
  REQUIRE(all.size() ==
          2);  // the first when the second began, the second as soon as all that the first had is there
  const Gnss& g = all[1];
  CHECK(g.latitude_deg == doctest::Approx(47.285235).epsilon(1e-12));  // 47 + 17.1141 / 60
  CHECK(g.longitude_deg == doctest::Approx(8.565265).epsilon(1e-12));
  CHECK(g.altitude_m == 500);
  CHECK(g.velocity_mps.north == doctest::Approx(0));
  CHECK(g.velocity_mps.east == doctest::Approx(10.2888889));  // 20 kt
  CHECK(g.horizontal_std_m == doctest::Approx(1.51327460));   // sqrt((1.7^2 + 1.3^2) / 2)
  CHECK(g.vertical_std_m == 2.2);
  CHECK(g.speed_std_mps == unknown_std);
  CHECK(g.utc_ns == 1039435201000000000);  // 2002-12-09 12:00:01
  CHECK(g.fix == FixType::fix_3d);
  CHECK(g.satellites == 9);
}

TEST_CASE("without GST the deviations come from the dilution of precision, and are unknown without any") {
  Epochs epochs(3);
  auto all = samples(epochs, epoch_text(0) + epoch_text(1));
  REQUIRE(all.size() == 2);
  CHECK(all[0].horizontal_std_m == doctest::Approx(2.12132034));  // 1.0 * 3 m / sqrt(2)
  CHECK(all[0].vertical_std_m == unknown_std);
  all = samples(epochs, framed("GNGSA,A,3,04,05,,09,12,,,24,,,,,2.5,1.3,2.1") + epoch_text(2));
  CHECK(all.back().vertical_std_m == doctest::Approx(6.3));
}

TEST_CASE(
    "every sentence of an epoch is waited for, whatever the order, and one that is lost once does not change "
    "that") {
  Epochs epochs;
  std::string text;
  for (int s = 0; s < 3; ++s) text += epoch_text(s);
  CHECK(samples(epochs, text).size() == 3);  // 0 when 1 began, from then on at once
  auto all = samples(epochs, epoch_text(3));
  CHECK(all.size() == 1);  // both sentences of 3 are there
  const std::string rmc_lost = epoch_text(4).substr(epoch_text(4).find("$GNGGA"));
  CHECK(samples(epochs, rmc_lost).empty());
  all = samples(epochs, epoch_text(5));
  REQUIRE(all.size() == 2);
  CHECK(all[0].velocity_mps.east == 0);  // 4, without a speed
  CHECK(all[0].utc_ns == 0);
  CHECK(all[1].velocity_mps.east > 10);  // 5: its RMC was waited for
}

TEST_CASE("silence ends an epoch, once") {
  Epochs epochs;
  int emitted = 0;
  const auto emit = [&](const Gnss&) { ++emitted; };
  CHECK(samples(epochs, epoch_text(0)).empty());
  epochs.flush(emit);
  epochs.flush(emit);
  CHECK(emitted == 1);
  CHECK(samples(epochs, epoch_text(1)).size() == 1);
}

TEST_CASE("a receiver without a fix is heard, but claims no position") {
  Epochs epochs;
  const std::string cold = framed("GPGGA,,,,,,0,00,99.99,,,,,,");
  const auto all = samples(epochs, cold + cold + cold);
  REQUIRE(all.size() == 3);
  CHECK(all[0].fix == FixType::none);
  CHECK(all[0].horizontal_std_m == unknown_std);
  CHECK(all[0].utc_ns == 0);
}

TEST_CASE("the quality of a fix becomes its type") {
  const auto type = [](char quality, int mode) {
    Epochs epochs;
    samples(epochs, framed("GPGSA,A," + std::to_string(mode) + ",04,05,,09,12,,,24,,,,,2.5,1.3,2.1"));
    samples(epochs, framed(std::string("GPGGA,123519,4807.038,N,01131.000,E,") + quality +
                           ",08,0.9,545.4,M,46.9,M,,"));
    FixType fix = FixType::time_only;
    epochs.flush([&](const Gnss& g) { fix = g.fix; });
    return fix;
  };
  CHECK(type('0', 3) == FixType::none);
  CHECK(type('1', 3) == FixType::fix_3d);
  CHECK(type('1', 2) == FixType::fix_2d);
  CHECK(type('2', 3) == FixType::fix_3d);
  CHECK(type('4', 3) == FixType::rtk_fixed);
  CHECK(type('5', 3) == FixType::rtk_float);
  CHECK(type('6', 3) == FixType::dead_reckoning);
}

TEST_CASE("a receiver that warns of its own speed is not believed it") {
  Epochs epochs;
  samples(epochs, epoch_text(0) + epoch_text(1));
  std::string warned = "GNRMC,120002.00,V,4717.1142,N,00833.9159,E,20.000,90.0,091202,,,N";
  const std::string both = epoch_text(2);
  const auto all = samples(epochs, framed(warned) + both.substr(both.find("$GNGGA")));
  REQUIRE(all.size() == 1);
  CHECK(all[0].velocity_mps.east == 0);
}

}  // namespace nmea_test
