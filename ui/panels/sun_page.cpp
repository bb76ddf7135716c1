#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <tuple>

#include "scene/settings_edits.h"
#include "ui/panels/panels.h"
#include "ui/sun_clock.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/slider.h"

// The sun: by day and hour where the site lies, or by hand.
namespace bosquet::ui {
namespace {

constexpr float kLowestSun_deg = 1.0f;  ///< that the window lets a hand or a clock set

constexpr std::array<const char*, 12> kMonths{"January", "February", "March",     "April",   "May",      "June",
                                              "July",    "August",   "September", "October", "November", "December"};

}  // namespace

void Panels::sun_fields(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  scene::Sun sun = document->sun;
  scene::Georeference place = document->place;
  const render::Place where{place.latitude_deg, place.longitude_deg, {}};
  // The sun of a file that was opened, of an undo or of a hand: the clock follows it.
  const auto follows = [&] { return std::tuple(sun, place.latitude_deg, place.longitude_deg); };
  if (app.clock_follows_ != follows()) {
    app.clock_follows_ = follows();
    const auto when = time_of_sun(sun, where, app.when_);
    app.sun_has_a_time_ = when.has_value();
    app.sun_is_down_ = false;
    if (when) app.when_ = *when;
  }
  ImGui::PushItemWidth(-1);
  int day = day_of_year(app.when_);
  const std::string date = fmt::format("{} {}", app.when_.day, kMonths[static_cast<std::size_t>(app.when_.month - 1)]);
  const int minutes = static_cast<int>(std::lround(60.0 * app.when_.hour));
  const std::string clock = fmt::format("{}:{:02}", minutes / 60, minutes % 60);
  auto latitude = static_cast<float>(place.latitude_deg);
  auto hour = static_cast<float>(app.when_.hour);
  bool timed = slider("Day", day, 1, kDaysOfYear, date.c_str());
  mark(app, "Day");
  explain("The sun as it stands on this day; shadows are longest in December, north of the equator");
  if (slider("Hour", hour, 0, 24, clock.c_str())) timed = true, app.when_.hour = std::round(4.0 * hour) / 4.0;
  mark(app, "Hour");
  explain("Clock time of the site's time zone, without summer time");
  const std::string degrees = fmt::format("{:.1f}\xc2\xb0 {}", std::abs(latitude), latitude < 0 ? "south" : "north");
  if (slider("Latitude", latitude, -66, 66, degrees.c_str()))
    timed = true, place.latitude_deg = static_cast<double>(latitude);
  mark(app, "Latitude");
  explain("Where the site lies: equator 0, Rome 42, Berlin 52.5, Oslo 60");
  bool moved = false;
  if (timed) {
    set_day_of_year(app.when_, day);
    const scene::Sun now = render::sun_position(app.when_, {place.latitude_deg, place.longitude_deg, {}});
    app.sun_is_down_ = now.elevation_deg < kLowestSun_deg;
    if (!app.sun_is_down_) sun = now;
    app.sun_has_a_time_ = moved = true;
    app.clock_follows_ = follows();
  }
  if (app.sun_is_down_) ImGui::TextDisabled("The sun is down then; it stays as it was.");
  if (!app.sun_has_a_time_) ImGui::TextWrapped("Set by hand: on no day does the sun stand there.");
  const bool turned = slider("From", sun.azimuth_deg, 0, 360, "%.0f\xc2\xb0");
  explain("Where the light comes from, from north clockwise");
  const bool raised = slider("Height", sun.elevation_deg, kLowestSun_deg, 90, "%.0f\xc2\xb0");
  explain("Of the sun above the horizon");
  if (turned || raised) app.sun_is_down_ = false, moved = true;
  ImGui::PopItemWidth();
  if (!moved) return;
  if (app.inspector_drag_ == 0) app.inspector_drag_ = new_drag();
  scene::Edited edit = scene::set_sun(scene::set_place(*document, place).document, sun);
  s.apply(std::move(edit), app.inspector_drag_);
}

}  // namespace bosquet::ui
