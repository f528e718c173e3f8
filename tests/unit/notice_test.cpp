// What the person in the headset reads, and when.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/notice/display_limits.hpp"
#include "app/notice/notice.hpp"

namespace {

using app::Notice;
using app::NoticeContent;
using app::PlateLine;
using Lines = std::vector<PlateLine>;

NoticeContent reading() {
  return {.pairs = {"progressive"},
          .gaze_source = "tracker",
          .rung = "tenth_px",
          .limits = {{.text = "Limits", .kind = PlateLine::Kind::heading}, {"Letters", "none"}}};
}

std::string text_of(const Lines& lines, const std::string& label) {
  const auto found = std::ranges::find(lines, label, &PlateLine::label);
  return found == lines.end() ? "" : found->text;
}

TEST(Notice, TellsEverythingFirstAndThenPairAndGazeForGood) {
  Notice notice;
  const NoticeContent content = reading();
  const auto first = notice.step(100.0, content);
  ASSERT_TRUE(first);
  EXPECT_EQ(text_of(*first, "Pair"), "progressive");
  EXPECT_EQ(text_of(*first, "Gaze"), app::gaze_source_text("tracker"));
  EXPECT_EQ(text_of(*first, "Accuracy"), "tenth_px");
  EXPECT_EQ(text_of(*first, "Letters"), "none");
  EXPECT_FALSE(notice.step(102.9, content)) << "no change, no new text";  // 3 s and its letters' time have not passed
  const auto brief = notice.step(130.0, content);
  ASSERT_TRUE(brief);
  EXPECT_EQ(*brief, (Lines{{.text = "progressive"},
                           {.text = "gaze: eye tracker \u00b7 tenth_px", .kind = PlateLine::Kind::quiet}}));
  EXPECT_FALSE(notice.step(1000.0, content));
}

TEST(Notice, AChangeBringsTheWholeBackWithoutTheLimits) {
  Notice notice;
  NoticeContent content = reading();
  ASSERT_TRUE(notice.step(0.0, content));
  ASSERT_TRUE(notice.step(30.0, content));
  const auto change = [&](double time, const char* label) {
    const auto lines = notice.step(time, content);
    EXPECT_TRUE(lines && !text_of(*lines, "Gaze").empty()) << label;
    EXPECT_TRUE(lines && text_of(*lines, "Letters").empty()) << label << ": the limits have not changed";
    EXPECT_TRUE(notice.step(time + 29.0, content)) << label << ": it has not become brief again";
    return lines ? text_of(*lines, label) : "";
  };
  content.pairs = {"bifocal"};
  EXPECT_EQ(change(100.0, "Pair"), "bifocal");
  content.map = "astigmatism";
  EXPECT_EQ(change(200.0, "Map"), "astigmatism");
  content.target = "near card";
  EXPECT_EQ(change(300.0, "Target"), "near card");
  content.warnings = {"the prisms differ"};
  EXPECT_EQ(change(400.0, "Warning"), "the prisms differ");
  content.pairs = {"no spectacles"};
  EXPECT_EQ(change(500.0, "Pair"), "no spectacles");
  content.pairs = {"bifocal", "progressive"};
  EXPECT_EQ(change(600.0, "B, right"), "progressive");
}

TEST(Notice, NamesBothPairsInBriefToo) {
  Notice notice;
  NoticeContent content = reading();
  content.pairs = {"bifocal", "progressive"};
  ASSERT_TRUE(notice.step(0.0, content));
  const auto brief = notice.step(30.0, content);
  ASSERT_TRUE(brief);
  EXPECT_EQ(text_of(*brief, "A"), "bifocal");
  EXPECT_EQ(text_of(*brief, "B"), "progressive");
  EXPECT_EQ(brief->size(), 3U);
}

TEST(Notice, AnotherSourceOrRungShowsInWhatAlwaysStays) {
  Notice notice;
  NoticeContent content = reading();
  ASSERT_TRUE(notice.step(0.0, content));
  ASSERT_TRUE(notice.step(30.0, content));
  content.rung = "quarter_px";
  const auto rung = notice.step(40.0, content);
  ASSERT_TRUE(rung);
  ASSERT_EQ(rung->size(), 2U);
  EXPECT_EQ(rung->back().text, "gaze: eye tracker \u00b7 quarter_px");
  content.gaze_source = "head";
  EXPECT_FALSE(notice.step(50.0, content)) << "a blink is no news";
  EXPECT_FALSE(notice.step(50.3, content));
  const auto source = notice.step(50.5, content);
  ASSERT_TRUE(source);
  ASSERT_EQ(source->size(), 2U);
  EXPECT_EQ(source->back().text, "gaze: head only \u00b7 quarter_px");
}

TEST(Notice, ABlinkIsNotNamed) {
  Notice notice;
  NoticeContent content = reading();
  ASSERT_TRUE(notice.step(0.0, content));
  ASSERT_TRUE(notice.step(30.0, content));
  for (int blink = 0; blink < 20; ++blink) {
    const double time = 40.0 + blink;
    content.gaze_source = "held";
    EXPECT_FALSE(notice.step(time, content));
    EXPECT_FALSE(notice.step(time + 0.3, content));
    content.gaze_source = "tracker";
    EXPECT_FALSE(notice.step(time + 0.35, content));
    EXPECT_FALSE(notice.step(time + 0.9, content));
  }
}

TEST(Notice, EverySourceIsNamed) {
  for (const char* source : {"tracker", "held", "head", "target", "replay"}) {
    EXPECT_NE(app::gaze_source_text(source), source);
  }
  EXPECT_EQ(app::gaze_source_text("another"), "another");
}

app::DisplayLimits headset_of(double pixels_per_degree) {
  app::DisplayLimits limits;
  limits.pixels_per_degree = pixels_per_degree;
  return limits;
}

TEST(DisplayLimits, OnePixelAStrokeIsTheFinestLetter) {
  const auto letters = [](double ppd) { return text_of(app::limit_lines(headset_of(ppd)), "Letters"); };
  // 20/20 is a stroke of 1 arcmin: 60 pixels a degree; 22 have 2.73 arcmin.
  EXPECT_EQ(letters(60.0), "finer than 20/20 (decimal 1.00, logMAR 0.00): one pixel covers 1.0\u2032");
  EXPECT_EQ(letters(22.0), "finer than 20/55 (decimal 0.37, logMAR +0.44): one pixel covers 2.7\u2032");
  EXPECT_EQ(letters(6.0), "finer than 20/200 (decimal 0.10, logMAR +1.00): one pixel covers 10.0\u2032");
}

TEST(DisplayLimits, ResolutionOfAnImageIsThatAtItsAxis) {
  // 90 degrees across in 1000 pixels: 500 a unit of the tangent, pi/180 of it a degree.
  EXPECT_NEAR(app::pixels_per_degree(1000, 1.0, 1.0), 8.7266, 1e-4);
  EXPECT_NEAR(app::pixels_per_degree(1000, 1.5, 0.5), 8.7266, 1e-4);
}

TEST(DisplayLimits, NameLightAndFocusAndAnUnknownViewer) {
  app::DisplayLimits limits = headset_of(22.0);
  limits.headset = {.focal_distance = 1.25, .luminance = 80.0};
  limits.pupil_diameter = 0.0041;
  limits.sunlit_pupil = 0.0023;
  const Lines lines = app::limit_lines(limits);
  EXPECT_EQ(lines.front().kind, PlateLine::Kind::heading);
  for (const char* part : {"80 cd/m", "4.1 mm", "2.3 mm"}) {
    EXPECT_NE(text_of(lines, "Light").find(part), std::string::npos) << part;
  }
  EXPECT_NE(text_of(lines, "Focus").find("1.25 m"), std::string::npos);
  EXPECT_EQ(text_of(lines, "Your eyes"), "");
  limits.viewer_known = false;
  EXPECT_NE(text_of(app::limit_lines(limits), "Your eyes"), "");
  limits.pupil_diameter = 0.002;  // of a wearer's file: smaller than sunlight leaves
  EXPECT_EQ(text_of(app::limit_lines(limits), "Light").find("pupil"), std::string::npos);
}

}  // namespace
