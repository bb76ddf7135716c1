#include "ui/input.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/ui/imgui_page.h"

namespace bosquet::ui {
namespace {

TEST(Input, AKeyPressedAndLetGoBetweenTwoFramesIsSeenByBothOfThem) {
  test::ImGuiPage page;
  Input::bind_keys();
  Input input;
  const std::array<Event, 2> tap{Event{.kind = Event::Kind::key_press, .key = kKeyBackspace},
                                 Event{.kind = Event::Kind::key_release, .key = kKeyBackspace}};
  int seen = 0;
  const auto look = [&] { seen += ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Backspace), false); };
  input.feed(tap);
  page.frame(look);
  EXPECT_EQ(seen, 1);
  EXPECT_TRUE(ImGui::GetIO().KeysDown[kKeyBackspace]);
  input.feed({});
  page.frame(look);
  EXPECT_EQ(seen, 1);
  EXPECT_FALSE(ImGui::GetIO().KeysDown[kKeyBackspace]);
}

TEST(Input, TwoClicksInOneFrameAreTwoClicks) {
  test::ImGuiPage page;
  Input input;
  std::vector<Event> events;
  for (int i = 0; i < 2; ++i) {
    events.push_back({.kind = Event::Kind::press, .at = {50, 20}, .button = Button::left});
    events.push_back({.kind = Event::Kind::release, .at = {50, 20}, .button = Button::left});
  }
  int clicks = 0;
  const auto button = [&] { clicks += ImGui::Button("press me", {200, 40}); };
  input.feed(std::array{Event{.kind = Event::Kind::move, .at = {50, 20}}});
  page.frame(button);
  input.feed(events);
  for (int i = 0; i < 5; ++i) {
    page.frame(button);
    input.feed({});
  }
  EXPECT_EQ(clicks, 2);
}

TEST(Input, TypedTextAndWheelArrive) {
  test::ImGuiPage page;
  Input input;
  input.feed(std::array{Event{.kind = Event::Kind::text, .key = 'b'}, Event{.kind = Event::Kind::scroll, .scroll = 2}});
  EXPECT_EQ(ImGui::GetIO().InputQueueCharacters.Size, 1);
  EXPECT_FLOAT_EQ(ImGui::GetIO().MouseWheel, 2);
  page.frame([] {});
}

TEST(Input, WhatComesAfterAClickWaitsSoThatItIsSeenWhereItWas) {
  test::ImGuiPage page;
  Input input;
  const std::array<Event, 4> click_and_go{Event{.kind = Event::Kind::move, .at = {50, 20}},
                                          Event{.kind = Event::Kind::press, .at = {50, 20}, .button = Button::left},
                                          Event{.kind = Event::Kind::release, .at = {50, 20}, .button = Button::left},
                                          Event{.kind = Event::Kind::move, .at = {300, 200}}};
  EXPECT_EQ(input.feed(click_and_go).size(), 2u);
  EXPECT_TRUE(ImGui::GetIO().MouseDown[0]);
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 50);
  ASSERT_TRUE(input.waiting());
  page.frame([] {});
  EXPECT_EQ(input.feed({}).size(), 1u);
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 50);
  ASSERT_TRUE(input.waiting());
  page.frame([] {});
  EXPECT_EQ(input.feed({}).size(), 1u);
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 300);
  EXPECT_FALSE(input.waiting());
  page.frame([] {});
}

}  // namespace
}  // namespace bosquet::ui
