// How keys.cpp states the keys of a section: one call for each.
#pragma once

#include <optional>
#include <utility>

#include "src/config/keys.hpp"

namespace barchan {

enum class Rule { none, required, fixed_by_restart, required_and_fixed };

/// Adds keys to a section. `Get`: from a Config to a pointer to the struct that holds the members,
/// nullptr where the section is absent.
template <class Get>
class Keys {
 public:
  Keys(Section& section, Get get) : section_(section), get_(get) {}

  template <class Struct, class T>
  void operator()(const char* name, T Struct::*member, const Range& range, const char* unit,
                  const char* meaning, Rule rule = Rule::none) {
    Key key;
    key.section = section_.name;
    key.name = name;
    key.type = type_text<T>();
    key.range = range;
    key.unit = unit;
    key.meaning = meaning;
    key.required = rule == Rule::required || rule == Rule::required_and_fixed;
    key.fixed_by_restart = rule == Rule::fixed_by_restart || rule == Rule::required_and_fixed;
    key.read = [get = get_, member, range, u = key.unit](const Node& node, Config& config) {
      T& value = get(config)->*member;
      T read = value;
      Mismatch mismatch = convert(node, read);
      if (!mismatch) mismatch = check(read, range, u);
      if (!mismatch) value = read;
      return mismatch;
    };
    key.text = [get = get_, member](const Config& config) -> std::optional<std::string> {
      const Struct* holder = get(config);
      if (holder == nullptr) return {};
      return optional_text(holder->*member);
    };
    key.same = [get = get_, member](const Config& a, const Config& b) {
      const Struct *in_a = get(a), *in_b = get(b);
      if (in_a == nullptr || in_b == nullptr) return in_a == in_b;
      return in_a->*member == in_b->*member;
    };
    section_.keys.push_back(std::move(key));
  }

 private:
  Section& section_;
  Get get_;
};

template <class T>
auto* if_there(T& optional) {
  return optional ? &*optional : nullptr;
}

}  // namespace barchan
