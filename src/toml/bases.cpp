// Cases that are based on others: [case] base, and the keys that they leave out.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "src/base/words.hpp"
#include "src/toml/case_text.hpp"
#include "src/toml/dotted.hpp"
#include "src/toml/keys.hpp"
#include "src/toml/reading.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

/// Puts the entries of `from` in place of those in `into`; tables are merged, lists are not.
void overlay(NodeTable& into, const NodeTable& from) {
  for (const auto& [name, node] : from) {
    Node& old = into.try_emplace(name, node).first->second;
    if (node.table() == nullptr || old.table() == nullptr) {
      old = node;
    } else {
      old.where = node.where;
      overlay(*old.table(), *node.table());
    }
  }
}

/// Takes a dotted key out of a tree; false if it is not there.
bool erase(Node& tree, std::string name) {
  NodeTable* table = tree.table();
  for (std::size_t dot = name.find('.'); table && dot != name.npos; dot = name.find('.')) {
    const auto at = table->find(name.substr(0, dot));
    table = at == table->end() ? nullptr : at->second.table();
    name.erase(0, dot + 1);
  }
  return table != nullptr && table->erase(name) > 0;
}

/// Entries of a list, or the one value.
std::vector<Node> entries_of(const Node* node) {
  if (node == nullptr) return {};
  const auto* list = std::get_if<NodeArray>(&node->value);
  return list != nullptr ? *list : std::vector{*node};
}

constexpr const char* kBase = "case.base";
constexpr const char* kWithout = "case.without";

}  // namespace

void ConfigReader::inherit() { tree_ = with_bases(std::move(tree_), file_, {}); }

/// Lays a tree, as it stands in `file`, over those of its bases. `chain`: the files that lead to
/// it.
Node ConfigReader::with_bases(Node own, const fs::path& file, std::vector<fs::path> chain) {
  chain.push_back(fs::weakly_canonical(file));
  Node all{NodeTable{}, own.where};
  const Node *bases = own.find(kBase), *without = own.find(kWithout);
  for (const Node& name : entries_of(bases)) add_base(all, name, file, chain);
  if (without != nullptr && bases == nullptr) {
    report_at(without, nullptr, kWithout, "must come with a base");
  } else {
    for (const Node& name : entries_of(without)) leave_out(all, name);
  }
  if (bases != nullptr || without != nullptr) {
    erase(own, kBase);
    erase(own, kWithout);
  }
  overlay(*all.table(), *own.table());
  return all;
}

/// Adds a base of `file`.
void ConfigReader::add_base(Node& all, const Node& name, const fs::path& file,
                            const std::vector<fs::path>& chain) {
  const auto refuse = [&](const std::string& why) { report_at(&name, nullptr, kBase, why); };
  const auto* text = std::get_if<std::string>(&name.value);
  if (text == nullptr) return refuse("must be a case file, or a list of them");
  const fs::path path = (file.parent_path() / *text).lexically_normal();
  std::error_code ignored;
  if (path.extension() != ".toml") return refuse("must be a file ending in .toml");
  if (!fs::exists(path, ignored)) {
    return refuse(fmt::format("must be a file that exists; there is no {}{}", path.string(),
                              nearest_file(path)));
  }
  if (std::ranges::find(chain, fs::weakly_canonical(path)) != chain.end())
    return refuse("must not lead back to this case");
  const auto written = case_text(path, problems_);
  if (!written) return;
  Node base = parse_toml(*written, path.string(), problems_);
  if (base.find("study") != nullptr) return refuse("must be a case; this is a study");
  base = with_bases(std::move(base), path, chain);
  erase(base, "case");  // each case has a title of its own
  overlay(*all.table(), *base.table());
}

/// Removes a key or a section from the values of the bases.
void ConfigReader::leave_out(Node& all, const Node& name) {
  const auto* text = std::get_if<std::string>(&name.value);
  if (text == nullptr)
    return report_at(&name, nullptr, kWithout, "must be a section or a key, or a list of them");
  const bool sets_it = erase(all, *text);
  if (!sets_it) report_at(&name, nullptr, kWithout, "must be a section or a key that the base has");
}

/// Layer in which a value was set: 1 in a base, 2 in the file, 3 by an assignment; 0: nowhere.
int ConfigReader::layer_of(const Node* node) const {
  if (node == nullptr) return 0;
  return node->where.line == 0 ? 3 : node->where.file == file_.string() ? 2 : 1;
}

bool ConfigReader::is_switched_off(const std::string& dotted, const std::string& by) const {
  const int own = layer_of(tree_.find(dotted));
  return own == 1 || (own == 2 && layer_of(tree_.find(by)) == 3);
}

void ConfigReader::drop_switched_off() {
  ConfigReader trial = *this;
  const std::shared_ptr<Config> config = blank_config();
  trial.read(*config);
  for (const Section& section : table_) {
    for (const Key& key : section.keys) {
      const std::string dotted = key.dotted();
      if (tree_.find(dotted) == nullptr || !key.text(*config, 0)) continue;
      const std::string_view by = switched_off_by(dotted, *config);
      if (!by.empty() && is_switched_off(dotted, std::string(by))) drop(dotted);
    }
  }
}

void ConfigReader::drop(const std::string& dotted) { erase(tree_, dotted); }

fs::path ConfigReader::folder_of(const std::string& dotted) const {
  const Node* node = tree_.find(dotted);
  const bool in_file = node != nullptr && node->where.line > 0;
  return (in_file ? fs::path(node->where.file) : file_).parent_path();
}

}  // namespace barchan
