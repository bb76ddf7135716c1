// A page of Dear ImGui without window or GPU: tests draw widgets in it and move a pointer over them.
#pragma once

#include <imgui.h>

#include <functional>

namespace bosquet::ui::test {

class ImGuiPage {
 public:
  explicit ImGuiPage(ImVec2 size = {800, 600}) : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = size;
    io.DeltaTime = 1.0f / 60.0f;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    io.MousePos = {-100, -100};
  }
  ~ImGuiPage() { ImGui::DestroyContext(context_); }
  ImGuiPage(const ImGuiPage&) = delete;
  ImGuiPage& operator=(const ImGuiPage&) = delete;

  /// Draws one frame of a window that fills the page.
  void frame(const std::function<void()>& content) {
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration);
    content();
    ImGui::End();
    ImGui::Render();
  }

  /// Presses at one place, moves to another and releases, a frame each.
  void drag(ImVec2 from, ImVec2 to, const std::function<void()>& content) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = from;
    frame(content);
    io.MouseDown[0] = true;
    frame(content);
    io.MousePos = to;
    frame(content);
    io.MouseDown[0] = false;
    frame(content);
  }

 private:
  ImGuiContext* context_;
};

}  // namespace bosquet::ui::test
