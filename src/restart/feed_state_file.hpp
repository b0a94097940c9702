// What a feed of grains remembers, in restart files. All ranks together.
#pragma once

#include "src/grains/feed_state.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// Nothing where no grains were fed so far, nor looked at for it.
void save_feed(CheckpointWriter& file, const FeedState& feed);

/// Of a run without a feed the state that a feed begins with, at the time of the file.
FeedState load_feed(const CheckpointReader& file);

}  // namespace barchan
