#include "ui/session.h"

#include <algorithm>

#include "core/letters.h"
#include "exchange/recipe.h"
#include "ui/tools/standing_edits.h"

namespace bosquet::ui {

Session::Session(Options options) : options_(std::move(options)), tool_(make_tool(ToolKind::select)) {
  growth_.threads = options_.threads;
  pipeline_ = std::make_unique<scene::Pipeline>(growth_);
  auto empty = make_template("Meadow");
  begin(empty ? std::move(*empty) : scene::Document{}, "Untitled");
}

Session::~Session() = default;

// Another document takes the place of the present one.
void Session::begin(scene::Document document, std::string name, const std::filesystem::path& recipe) {
  journal_.reset();
  history_ = std::make_unique<scene::History>(document);
  planting_ = {};
  selection_.clear();
  tool_->cancel();
  asked_trees_ = 0;
  name_ = std::move(name);
  saved_revision_ = history_->revision();
  edit_ = 0;
  if (options_.journal) {
    const std::filesystem::path folder =
        options_.recovery_folder.empty() ? scene::recovery_folder() : options_.recovery_folder;
    auto journal = scene::Journal::start(document, recipe.empty() ? path_ : recipe, folder);
    if (journal)
      journal_ = std::move(*journal);
    else
      message = "Edits are not kept against a crash: " + journal.error().message;
  }
  const Vec2 size = document.terrain->size_m();
  const float ground = document.terrain->ground(0.5f * size);
  if (!document.cameras.empty())
    rig.look(document.cameras.front());
  else
    rig.frame({{0.0f, ground, -size.y}, {size.x, ground + 0.1f * std::max(size.x, size.y), 0.0f}}, 1.5f);
  rig.keep_above(*document.terrain);
  ++revision_;
  looked_from_ = rig.eye();
  pipeline_->set_document(history_->current(), {looked_from_});
}

void Session::changed() {
  ++revision_;
  ++edit_;
  // What is gone cannot be selected.
  std::erase_if(selection_,
                [&](std::int32_t id) { return id > 0 ? !document()->trees->find(id) : !find_hero(*document(), id); });
  looked_from_ = rig.eye();
  pipeline_->set_document(document(), {looked_from_});
  if (journal_) journal_->record(*document(), edit_);
}

void Session::apply(scene::Edited edit, std::uint64_t drag) {
  history_->add(std::move(edit), drag);
  changed();
}

void Session::undo() {
  tool_->cancel();
  if (!history_->can_undo()) return;
  history_->undo();
  changed();
}

void Session::redo() {
  tool_->cancel();
  if (!history_->can_redo()) return;
  history_->redo();
  changed();
}

void Session::go_to(std::size_t step) {
  if (step == history_->place() || step >= history_->steps()) return;
  tool_->cancel();
  history_->go_to(step);
  changed();
}

Result<OpenedDocument> read_document(const std::filesystem::path& file) {
  OpenedDocument opened;
  const std::string ending = folded_letters(file.extension().string());
  if (ending == ".toml") {
    auto recipe = exchange::read_recipe(file);
    if (!recipe) return recipe.error();
    auto built = exchange::build_document(*recipe);
    if (!built) return built.error();
    opened.document = std::move(built->document);
    opened.notes = std::move(built->warnings);
  } else if (ending == ".bosquet") {
    auto project = scene::read_project(file);
    if (!project) return project.error();
    opened.document = std::move(project->document);
    opened.notes = scene::lines(project->state);
  } else {
    return Error{file.string() + ": is neither a project (.bosquet) nor a recipe (.toml)"};
  }
  scene::settle_counters(opened.document);
  return opened;
}

Result<void> Session::open(const std::filesystem::path& file) {
  if (folded_letters(file.extension().string()) == ".bosquet") {
    auto project = scene::ProjectFile::open(file);
    if (!project) return project.error();
    notes = scene::lines(project->state());
    scene::Document document = project->document();
    project_.emplace(std::move(*project));
    path_ = file;
    begin(std::move(document), file.stem().string());
    return {};
  }
  auto opened = read_document(file);
  if (!opened) return opened.error();
  notes = std::move(opened->notes);
  project_.reset();
  path_.clear();
  begin(std::move(opened->document), file.stem().string(), file);
  return {};
}

void Session::start(scene::Document document, std::string name) {
  project_.reset();
  path_.clear();
  notes.clear();
  begin(std::move(document), std::move(name));
}

std::string Session::read_only() const { return project_ ? project_->state().read_only : std::string(); }

Result<void> Session::save() {
  if (!project_) return Error{"the document has no file yet: save it under a name"};
  if (auto saved = project_->save(*document()); !saved) return saved;
  saved_revision_ = history_->revision();
  if (journal_) journal_->saved(path_, edit_);
  return {};
}

Result<void> Session::save_as(const std::filesystem::path& file) {
  if (project_) {
    if (auto saved = project_->save_as(*document(), file); !saved) return saved;
  } else {
    auto made = scene::ProjectFile::create(file, *document());
    if (!made) return made.error();
    project_.emplace(std::move(*made));
  }
  path_ = file;
  name_ = file.stem().string();
  saved_revision_ = history_->revision();
  if (journal_) journal_->saved(path_, edit_);
  return {};
}

std::string Session::name() const { return name_; }

Result<void> Session::recover(const scene::Recovery& recovery) {
  auto recovered = scene::recover(recovery);
  if (!recovered) return recovered.error();
  notes = scene::lines(recovered->state);
  project_.reset();
  path_.clear();
  begin(std::move(recovered->document),
        recovery.project.empty() ? "Recovered" : recovery.project.stem().string() + " (recovered)");
  saved_revision_ = history_->revision() - 1;  // nothing of it is saved
  // The journal of this session holds it now as an edit of its own.
  if (journal_) {
    journal_->record(*document(), ++edit_);
    journal_->wait();
    if (journal_->problem().empty()) scene::discard(recovery);
  }
  return {};
}

void Session::select(std::vector<std::int32_t> trees) {
  selection_ = std::move(trees);
  std::sort(selection_.begin(), selection_.end());
}

const scene::Tree* Session::selected_tree() const {
  return selection_.size() == 1 ? document()->trees->find(selection_.front()) : nullptr;
}

const scene::HeroTree* Session::selected_hero() const {
  return selection_.size() == 1 ? find_hero(*document(), selection_.front()) : nullptr;
}

void Session::take(ToolKind kind) {
  tool_->cancel();
  decline_trees();
  tool_kind_ = kind;
  tool_ = make_tool(kind);
}

ToolScene Session::tool_scene(Vec2 view_size) {
  return {document(), selection_, rig, view_size, &settings, &planting_};
}

void Session::use(ToolAnswer answer) {
  if (answer.edit) apply(std::move(*answer.edit), answer.drag);
  if (answer.selection) select(std::move(*answer.selection));
  if (!answer.message.empty()) message = std::move(answer.message);
  if (answer.asks_for_trees > 0) asked_trees_ = answer.asks_for_trees;
}

void Session::send(const ToolEvent& event, Vec2 view_size) { use(tool_->handle(event, tool_scene(view_size))); }
void Session::tick(double time_s, Vec2 view_size) { use(tool_->tick(time_s, tool_scene(view_size))); }

void Session::look_from_here() {
  const Vec3 eye = rig.eye();
  if (eye == looked_from_) return;
  looked_from_ = eye;
  pipeline_->set_view({eye});
}

void Session::confirm_trees(Vec2 view_size) {
  asked_trees_ = 0;
  use(tool_->confirm(tool_scene(view_size)));
}

void Session::decline_trees() {
  asked_trees_ = 0;
  tool_->cancel();
}

void Session::set_growth(const scene::PipelineOptions& options) {
  growth_ = options;
  pipeline_->set_options(options);
}

void Session::set_fineness(float fineness) {
  growth_.fineness = fineness;
  pipeline_->set_options(growth_);
}

void Session::set_year(std::optional<float> year) {
  growth_.year = year;
  pipeline_->set_options(growth_);
}

}  // namespace bosquet::ui
