#include "app/stall_meter.h"

#include <gtest/gtest.h>

namespace sward::editor {
namespace {

TEST(StallMeter, CountsFramesWhileBakingAlone) {
  StallMeter meter;
  meter.add(1000.0, false);
  EXPECT_EQ(meter.frames(), 0u);
  EXPECT_EQ(meter.worstMs(), 0.0);
  meter.add(5.0, true);
  meter.add(12.0, true);
  meter.add(13.0, true);
  meter.add(700.0, true);
  EXPECT_EQ(meter.frames(), 4u);
  EXPECT_EQ(meter.worstMs(), 700.0);
  EXPECT_EQ(meter.whileBaking()[0], 1u);
  EXPECT_EQ(meter.whileBaking()[1], 2u);
  EXPECT_EQ(meter.whileBaking().back(), 1u);
  EXPECT_EQ(meter.medianMs(), 16.0);
  EXPECT_NE(meter.text().find("over 500 ms: 1"), std::string::npos);
  EXPECT_NE(meter.text().find("longest: 700 ms"), std::string::npos);
}

}  // namespace
}  // namespace sward::editor
