// The compact forms against the published tables, and the script that fits them.

#include "leaf/spectra.h"

#include "leaf/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace sward::leaf {
namespace {

struct Misfit {
  double rmse = 0.0, max = 0.0, peak = 0.0;
};

/// Over 400 to 750 nm, at 1 nm.
Misfit misfit(const Samples& table, const std::function<double(double)>& form) {
  Misfit m;
  double squares = 0.0;
  int count = 0;
  for (double nm = kFirstNm; nm <= kLastNm; nm += 1.0) {
    const double truth = valueAt(table, nm), error = form(nm) - truth;
    squares += error * error;
    m.max = std::max(m.max, std::abs(error));
    m.peak = std::max(m.peak, std::abs(truth));
    ++count;
  }
  m.rmse = std::sqrt(squares / count);
  return m;
}

Samples column(const std::vector<std::vector<double>>& rows, std::size_t wavelengths, std::size_t values) {
  Samples samples;
  for (const auto& row : rows) {
    if (row.size() > std::max(wavelengths, values)) samples.emplace_back(row[wavelengths], row[values]);
  }
  return samples;
}

/// With the wavelength in front, which the rows of PROSPECT-5 lack: row i is 400 + i nm.
std::vector<std::vector<double>> numbered(const std::vector<std::vector<double>>& rows) {
  std::vector<std::vector<double>> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<double>& row = all.emplace_back(rows[i].size() + 1);
    row[0] = 400.0 + static_cast<double>(i);
    std::copy(rows[i].begin(), rows[i].end(), row.begin() + 1);
  }
  return all;
}

TEST(Spectra, CoefficientsFollowTheirPublishedTables) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  const auto five = numbered(numberRows(spectraFolder() / "prospect/prospect5_spectra.txt"));
  const auto late = numberRows(spectraFolder() / "prospect/prospect_d_spectra.txt");
  struct Case {
    const char* name;
    Samples table;
    Calibration calibration;
    double Absorption::*member;
  };
  const auto c5 = Calibration::Prospect5, cD = Calibration::ProspectD;
  const Case cases[] = {
      {"index 5", column(five, 0, 1), c5, &Absorption::refractiveIndex},
      {"chlorophyll 5", column(five, 0, 2), c5, &Absorption::chlorophyll},
      {"carotenoid 5", column(five, 0, 3), c5, &Absorption::carotenoid},
      {"brown", column(five, 0, 4), c5, &Absorption::brown},
      {"water", column(five, 0, 5), c5, &Absorption::water},
      {"dry matter", column(five, 0, 6), c5, &Absorption::dryMatter},
      {"index D", column(late, 0, 1), cD, &Absorption::refractiveIndex},
      {"chlorophyll D", column(late, 0, 2), cD, &Absorption::chlorophyll},
      {"carotenoid D", column(late, 0, 3), cD, &Absorption::carotenoid},
      {"brown D", column(late, 0, 5), cD, &Absorption::brown},
      {"dry matter D", column(late, 0, 7), cD, &Absorption::dryMatter},
  };
  for (const Case& one : cases) {
    ASSERT_GT(one.table.size(), 351u) << one.name;
    const Misfit m = misfit(one.table, [&](double nm) { return absorptionAt(nm, one.calibration).*one.member; });
    // What the header states: 0.4 % of the greatest value, and nowhere more than 2.1 %.
    EXPECT_LT(m.rmse, 0.004 * m.peak) << one.name;
    EXPECT_LT(m.max, 0.021 * m.peak) << one.name << " " << m.max << " of " << m.peak;
  }
}

TEST(Spectra, PigmentsFollowTheirPublishedTables) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  constexpr double kPeak = 111700.0;
  Samples a = column(numberRows(spectraFolder() / "pigments/chla-123-abs.txt"), 0, 1);
  Samples b = column(numberRows(spectraFolder() / "pigments/chlb-125-abs.txt"), 0, 1);
  for (auto* table : {&a, &b}) {
    for (auto& sample : *table) sample.second /= kPeak;
  }
  a.emplace_back(701.0, 0.0);  // the table ends at 700 nm, where next to nothing is absorbed
  const Misfit ma = misfit(a, [](double nm) { return pigmentAbsorbanceAt(nm).chlorophyllA; });
  const Misfit mb = misfit(b, [](double nm) { return pigmentAbsorbanceAt(nm).chlorophyllB; });
  EXPECT_LT(ma.rmse, 0.003);
  EXPECT_LT(ma.max, 0.02);
  EXPECT_LT(mb.rmse, 0.003);
  EXPECT_LT(mb.max, 0.02);
}

TEST(Spectra, PigmentsAbsorbWhereTextbooksSay) {
  // Soret and Q bands: 428 and 662 nm for a, 453 and 644 for b (Strain et al. 1963, Vernon and Seely 1966); carotenoids
  // take blue alone.
  const auto peak = [](double from, double to, double PigmentAbsorbance::*member) {
    double best = from;
    for (double nm = from; nm <= to; nm += 0.5) {
      if (pigmentAbsorbanceAt(nm).*member > pigmentAbsorbanceAt(best).*member) best = nm;
    }
    return best;
  };
  EXPECT_NEAR(peak(400, 500, &PigmentAbsorbance::chlorophyllA), 428.0, 1.5);
  EXPECT_NEAR(peak(600, 700, &PigmentAbsorbance::chlorophyllA), 661.0, 2.0);
  EXPECT_NEAR(peak(420, 500, &PigmentAbsorbance::chlorophyllB), 453.0, 1.5);
  EXPECT_NEAR(peak(600, 700, &PigmentAbsorbance::chlorophyllB), 643.0, 2.0);
  EXPECT_LT(pigmentAbsorbanceAt(580.0).carotenoid, 0.01);
  EXPECT_GT(pigmentAbsorbanceAt(450.0).carotenoid, 1.0);
}

TEST(Spectra, ObserverAndDaylightFollowTheCie) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  const auto rows = numberRows(spectraFolder() / "cie/cie1931_2deg_xyz_360-830_1nm.csv");
  EXPECT_LT(misfit(column(rows, 0, 1), [](double nm) { return observerAt(nm).x; }).max, 0.01);
  EXPECT_LT(misfit(column(rows, 0, 2), [](double nm) { return observerAt(nm).y; }).max, 0.01);
  EXPECT_LT(misfit(column(rows, 0, 3), [](double nm) { return observerAt(nm).z; }).max, 0.01);
  Samples d65 = column(numberRows(spectraFolder() / "cie/cie_illuminant_D65_300-830_5nm.csv"), 0, 1);
  for (auto& sample : d65) sample.second /= 100.0;
  EXPECT_LT(misfit(d65, daylightAt).max, 0.025);
}

TEST(Spectra, AreNeverNegativeNorInfinite) {
  for (double nm = kFirstNm; nm <= kLastNm; nm += 0.25) {
    for (const Calibration calibration : {Calibration::Prospect5, Calibration::ProspectD}) {
      const Absorption a = absorptionAt(nm, calibration);
      for (const double value : {a.chlorophyll, a.carotenoid, a.brown, a.water, a.dryMatter}) {
        EXPECT_GE(value, 0.0);
        EXPECT_TRUE(std::isfinite(value));
      }
      EXPECT_GT(a.refractiveIndex, 1.35);
      EXPECT_LT(a.refractiveIndex, 1.6);
    }
  }
}

TEST(Spectra, ScriptFitsWhatTheSourceHolds) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  const std::string python = SWARD_PYTHON;
  if (std::system((python + " -c 'import numpy' 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "no NumPy";
  const std::string source = std::string(SWARD_SOURCE_DIR);
  const std::string command = python + " -B '" + source + "/tests/leaf/fit_spectra.py' '" + spectraFolder().string() +
                              "' --check '" + source + "/core/leaf/spectra_lobes.h'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  // And it does find a difference: a source that lacks everything.
  EXPECT_NE(std::system((command.substr(0, command.rfind(" '")) + " /dev/null > /dev/null").c_str()), 0);
}

}  // namespace
}  // namespace sward::leaf
