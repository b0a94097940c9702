// State of a feed of grains in restart files. All ranks together.
#pragma once

#include "src/grains/feed_state.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// Writes the state; nothing where no grains were fed so far, nor looked at for it.
void save_feed(CheckpointWriter& file, const FeedState& feed);

/// Reads the state. If the file has no feed: the initial one, at the time of the file.
FeedState load_feed(const CheckpointReader& file);

}  // namespace barchan
