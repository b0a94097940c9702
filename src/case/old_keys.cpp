// Keys of earlier versions, which still work.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "src/toml/keys.hpp"
#include "src/toml/reading.hpp"

namespace barchan {
namespace {

// Keys before and after: until version 0.3 coupling.exchange times coupling.void_fraction stood for
// coupling.scheme.
constexpr const char *kExchange = "coupling.exchange", *kFraction = "coupling.void_fraction",
                     *kScheme = "coupling.scheme",
                     *kSmoothExchange = "coupling.cfdem.smooth_exchange";
constexpr std::string_view kExchanges[] = {"by_row", "interpolated", "smoothed"},
                           kFractions[] = {"divided", "cfdem_faithful", "centre"};

struct OldExchange {
  std::string exchange = "by_row", void_fraction = "divided";
};

std::string fraction_key(const std::string& scheme) {
  return fmt::format("coupling.{}.void_fraction", scheme);
}

std::string text_of(const Node* node) {
  const auto* text = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  return text != nullptr ? *text : "";
}

/// Scheme of a tree, in the words of before.
OldExchange in_old_words(const Node& tree) {
  const std::string scheme = text_of(tree.find(kScheme));
  OldExchange old;
  if (scheme == "centred" || scheme == "cfdem") old.exchange = "interpolated";
  if (scheme == "smoothed") old.exchange = "smoothed";
  if (scheme == "cfdem") {
    old.void_fraction = "cfdem_faithful";
    const Node* smooths = tree.find(kSmoothExchange);
    const bool* yes = smooths != nullptr ? std::get_if<bool>(&smooths->value) : nullptr;
    if (yes != nullptr && *yes) old.exchange = "smoothed";
  } else if (text_of(tree.find(fraction_key(scheme))) == "centre") {
    old.void_fraction = "centre";
  }
  return old;
}

struct Assignment {
  std::string key;
  Node value;
  bool is_default;
};

/// Assignments in the words of today, at a place.
std::vector<Assignment> in_new_words(const OldExchange& old, const Location& where) {
  const bool smooths = old.exchange == "smoothed";
  if (old.void_fraction == "cfdem_faithful")
    return {{kScheme, {"cfdem", where}, false}, {kSmoothExchange, {smooths, where}, !smooths}};
  if (old.exchange == "by_row" && old.void_fraction == "divided")
    return {{kScheme, {"layered", where}, false}};
  const std::string scheme = smooths ? "smoothed" : "centred";
  return {{kScheme, {scheme, where}, false},
          {fraction_key(scheme), {old.void_fraction, where}, old.void_fraction == "divided"}};
}

void assign(Node& tree, const Assignment& one) {
  Node* at = &tree;
  for (std::string_view rest = one.key; at != nullptr && !rest.empty();) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    at = at->part(rest.substr(0, dot), one.value.where);
    rest.remove_prefix(std::min(dot + 1, rest.size()));
  }
  if (at != nullptr) *at = one.value;
}

std::string in_words(const OldExchange& old, const std::vector<Assignment>& today) {
  std::string keys;
  for (const auto& [key, value, is_default] : today)
    if (!is_default)
      keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", key, toml_text(value));
  std::string text = "has become coupling.scheme; today: " + keys;
  if (old.exchange == "by_row" && old.void_fraction != "divided")
    text += fmt::format(" (it always was: by_row has no \"{}\")", old.void_fraction);
  return text;
}

}  // namespace

/// Reads an old key, if it is there, into `word`; false if it is none of its words.
bool ConfigReader::take_old_word(const char* key, std::span<const std::string_view> words,
                                 std::string& word) {
  const Node* node = tree_.find(key);
  if (node == nullptr) return true;
  word = text_of(node);
  if (std::ranges::find(words, word) != words.end()) return true;
  report_error(key, fmt::format("must be \"{}\"; today the key is coupling.scheme",
                                fmt::join(words, "\", \"")));
  return false;
}

void ConfigReader::renew_old_keys() {
  const Node *exchange = tree_.find(kExchange), *fraction = tree_.find(kFraction);
  const Node* last = layer_of(fraction) > layer_of(exchange) ? fraction : exchange;
  if (last == nullptr) return;
  const int layer = layer_of(last), of_scheme = layer_of(tree_.find(kScheme));
  OldExchange old = in_old_words(tree_);
  if (take_old_word(kExchange, kExchanges, old.exchange) &&
      take_old_word(kFraction, kFractions, old.void_fraction) && layer >= of_scheme) {
    const std::vector<Assignment> today = in_new_words(old, last->where);
    const std::string message = in_words(old, today);
    if (layer == of_scheme) {
      report_error(last == exchange ? kExchange : kFraction, message + "; and scheme is set, too");
    } else {
      for (const auto& [key, node] : {std::pair{kExchange, exchange}, {kFraction, fraction}})
        if (node != nullptr) notices_.push_back(problem(node->where, key, false, node, message));
      for (const Assignment& one : today) assign(tree_, one);
    }
  }
  drop(kExchange), drop(kFraction);
}

}  // namespace barchan
