// Words from outside: what a misspelt one was meant for, and how to show them in messages.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace barchan {

/// The candidate nearest to `typed` by edits (a swap of neighbours counts once); empty if none is
/// near enough to be meant.
std::string nearest(std::string_view typed, std::span<const std::string> candidates);

/// " (did you mean "restitution"?)"; empty if `close` is.
std::string did_you_mean(std::string_view close);

/// " (did you mean configs/quickstart.toml?)" for a `path` that is not there: with the ending
/// .toml, in the folder configs, or the file of its kind beside it whose name is nearest; empty if
/// there is none.
std::string nearest_file(const std::filesystem::path& path);

/// What a case is called by its file, and so its run folder in runs/ by default: the path below the
/// last folder called configs, or else the name of the file, without its last ending. The launcher
/// (default_run_dir) and Python (run_name) have the same rule.
std::filesystem::path case_name(const std::filesystem::path& file);

/// Where cases that the case `file` starts from have their run folders, each by its name: runs/ if
/// `folder`, that of its own run, is runs/NAME or beside it; else the folder that `folder` is in.
std::filesystem::path folder_of_runs(const std::filesystem::path& file,
                                     const std::filesystem::path& folder);

/// Text with what a terminal would obey or could not show spelt out: control characters and bytes
/// that are not UTF-8 as \n, \x1b, \xff; `longest` bytes at most, then "...".
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// The same for a message of several lines: these stay.
std::string printable_lines(std::string_view text);

/// Names as one text for a file, a line each, and back.
std::string as_lines(std::span<const std::string> names);
std::vector<std::string> lines_of(std::string_view text);

}  // namespace barchan
