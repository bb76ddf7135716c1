// History: the documents of a session with the names of the edits between them, for undo and redo.
//
// Model     a list of documents, one of which is current; an edit drops what was undone and adds one. Documents share
//           what edits did not touch, so that a step keeps what it changed
// Decision  a drag (an edit that goes on while a button is held) is one step: edits of the same drag, which is any number
//           but 0, replace each other
// Decision  the list ends at most_steps or most_bytes, whichever comes first; the oldest steps go, the current stays
// Holds     undo and redo give back the same document, counters and all; revision() never repeats
// Threads   one; documents may be handed to any
// Cost      undo and redo: a pointer. An edit: comparing which parts it shares with the document before it
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "scene/document.h"
#include "scene/edits.h"

namespace bosquet::scene {

class History {
 public:
  static constexpr std::size_t kMostSteps = 1000;
  static constexpr std::size_t kMostBytes = std::size_t{200} << 20;

  explicit History(Document start, std::string name = "Open", std::size_t most_steps = kMostSteps,
                   std::size_t most_bytes = kMostBytes);

  /// The document now; whoever holds it keeps it.
  const std::shared_ptr<const Document>& current() const { return steps_[now_].document; }
  /// The document that the drag going on began with: what the edits of a drag are to be made from.
  const std::shared_ptr<const Document>& before_drag(std::uint64_t drag) const;

  /// Makes the document after an edit the current one. What was undone goes.
  void add(Edited edit, std::uint64_t drag = 0);
  void add(Document document, std::string name, std::uint64_t drag = 0);

  bool can_undo() const { return now_ > 0; }
  bool can_redo() const { return now_ + 1 < steps_.size(); }
  /// Name of the edit that would be undone or redone.
  const std::string& undo_name() const { return steps_[now_].name; }
  const std::string& redo_name() const { return steps_[now_ + 1].name; }
  void undo();
  void redo();

  // For a panel: step 0 is what was opened (or the oldest kept), place() the current one.
  std::size_t steps() const { return steps_.size(); }
  std::size_t place() const { return now_; }
  const std::string& name(std::size_t step) const { return steps_[step].name; }
  void go_to(std::size_t step);

  /// A number that is another after each change of the current document: for whoever writes journals or saves.
  std::uint64_t revision() const { return revision_; }

  /// About what the steps keep beside the current document.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Step {
    std::shared_ptr<const Document> document;
    std::string name;
    std::uint64_t drag = 0;
    std::size_t bytes = 0;  ///< that this step and the one before it do not share
  };
  void trim();

  std::deque<Step> steps_;
  std::size_t now_ = 0;
  std::size_t most_steps_, most_bytes_;
  std::size_t bytes_ = 0;
  std::uint64_t revision_ = 0;
};

/// About the memory that two documents do not share.
std::size_t bytes_apart(const Document& a, const Document& b);

}  // namespace bosquet::scene
