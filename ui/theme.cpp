#include "ui/theme.h"

#include <array>
#include <filesystem>
#include <string>

namespace bosquet::ui {
namespace {

constexpr float kTextPixels = 15.0f, kHeadingPixels = 18.0f;

std::string first_there(std::initializer_list<const char*> paths) {
  for (const char* path : paths)
    if (std::error_code ec; std::filesystem::exists(path, ec)) return path;
  return {};
}

ImVec4 shade(int rgb, float alpha = 1.0f) {
  return {static_cast<float>(rgb >> 16 & 255) / 255.0f, static_cast<float>(rgb >> 8 & 255) / 255.0f,
          static_cast<float>(rgb & 255) / 255.0f, alpha};
}

}  // namespace

Fonts load_fonts(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const std::string text = first_there(
      {"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"});
  const std::string heading = first_there(
      {"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf", "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"});
  const std::string icons = first_there({"/usr/share/fonts-font-awesome/fonts/fontawesome-webfont.ttf",
                                         "/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf"});
  // Latin, general punctuation (dashes, quotes, bullets) and arrows.
  static constexpr std::array<ImWchar, 7> kLetters{0x20, 0x17f, 0x2010, 0x2044, 0x2190, 0x21ff, 0};
  static constexpr std::array<ImWchar, 3> kIcons{0xf000, 0xf2e0, 0};
  Fonts fonts;
  const auto add = [&](const std::string& path, float pixels) {
    ImFont* font = path.empty() ? io.Fonts->AddFontDefault()
                                : io.Fonts->AddFontFromFileTTF(path.c_str(), pixels * scale, nullptr, kLetters.data());
    if (!icons.empty()) {
      ImFontConfig merged;
      merged.MergeMode = true;
      merged.GlyphMinAdvanceX = pixels * scale;
      fonts.icons = io.Fonts->AddFontFromFileTTF(icons.c_str(), pixels * scale, &merged, kIcons.data()) != nullptr;
    }
    return font;
  };
  fonts.text = add(text, kTextPixels);
  fonts.heading = add(heading, kHeadingPixels);
  return fonts;
}

void apply_theme(bool dark, float scale) {
  ImGuiStyle style;
  style.WindowRounding = 0;
  style.ChildRounding = style.PopupRounding = 6;
  style.FrameRounding = style.GrabRounding = 5;
  style.ScrollbarRounding = 6;
  style.TabRounding = 5;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowPadding = {10, 10};
  style.FramePadding = {8, 5};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  // Green of leaves for what is chosen, quiet greys for all else.
  const int back = dark ? 0x1f2421 : 0xf3f4f0, panel = dark ? 0x272d29 : 0xffffff, field = dark ? 0x343c37 : 0xe6e9e2;
  const int hover = dark ? 0x435048 : 0xd6dccf, text = dark ? 0xe8ebe4 : 0x20261f, dim = dark ? 0x8f9a90 : 0x75806f;
  const int green = dark ? 0x7fb069 : 0x4c8a3a, deep = dark ? 0x4d7a3f : 0xb9d8ab;
  ImVec4* c = style.Colors;
  if (dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  c[ImGuiCol_Text] = shade(text);
  c[ImGuiCol_TextDisabled] = shade(dim);
  c[ImGuiCol_WindowBg] = shade(panel);
  c[ImGuiCol_ChildBg] = shade(panel, 0.0f);
  c[ImGuiCol_PopupBg] = shade(panel);
  c[ImGuiCol_MenuBarBg] = shade(back);
  c[ImGuiCol_Border] = shade(hover);
  c[ImGuiCol_FrameBg] = shade(field);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_FrameBgActive] = shade(hover);
  c[ImGuiCol_Button] = shade(field);
  c[ImGuiCol_ButtonHovered] = shade(hover);
  c[ImGuiCol_ButtonActive] = shade(deep);
  c[ImGuiCol_Header] = shade(deep, 0.7f);
  c[ImGuiCol_HeaderHovered] = shade(hover);
  c[ImGuiCol_HeaderActive] = shade(deep);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = c[ImGuiCol_PlotHistogram] =
      shade(green);
  c[ImGuiCol_Tab] = shade(field);
  c[ImGuiCol_TabHovered] = shade(hover);
  c[ImGuiCol_TabActive] = shade(deep);
  c[ImGuiCol_Separator] = shade(hover);
  c[ImGuiCol_ScrollbarBg] = shade(panel, 0.0f);
  c[ImGuiCol_ScrollbarGrab] = shade(hover);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = shade(back);
  c[ImGuiCol_ModalWindowDimBg] = shade(0x000000, 0.45f);
  c[ImGuiCol_NavHighlight] = shade(green);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace bosquet::ui
