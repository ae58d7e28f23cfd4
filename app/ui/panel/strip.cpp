#include "app/ui/panel/strip.h"

#include <algorithm>
#include <cmath>

namespace gearshift::ui {

Strip::Strip(double span, int columns) : span_(span), columns_(static_cast<std::size_t>(columns)) {}

std::int64_t Strip::place(double time) const noexcept {
  return static_cast<std::int64_t>(std::floor(time / span_ * static_cast<double>(columns_.size())));
}

StripColumn& Strip::slot(std::int64_t place) noexcept {
  const auto size = static_cast<std::int64_t>(columns_.size());
  return columns_[static_cast<std::size_t>((place % size + size) % size)];
}

const StripColumn& Strip::column(int from_oldest) const noexcept {
  return const_cast<Strip*>(this)->slot(newest_ - columns() + 1 + from_oldest);
}

void Strip::clear_columns() {
  std::fill(columns_.begin(), columns_.end(), StripColumn{});
}

void Strip::push(double time, double value) {
  if (!std::isfinite(time) || !std::isfinite(value)) return;
  if (!samples_.empty() && time < samples_.back().time) {
    samples_.clear();
    clear_columns();
  }
  add({time, value});
  samples_.push_back({time, value});
  while (samples_.front().time < time - span_) samples_.pop_front();
}

// Adds the sample to its column. If the sample starts a new column, first clears this column and the columns skipped
// since the previous sample, because their values are outdated.
void Strip::add(const Sample& sample) {
  const std::int64_t here = place(sample.time);
  const bool first = samples_.empty();
  const std::int64_t from = first ? here : std::max(newest_ + 1, here - columns() + 1);
  for (std::int64_t i = from; i <= here; ++i) slot(i) = {};
  newest_ = here;
  StripColumn& column = slot(here);
  if (column.count == 0) column = {sample.value, sample.value, sample.value, sample.value, 0};
  column.min = std::min(column.min, sample.value);
  column.max = std::max(column.max, sample.value);
  column.last = sample.value;
  ++column.count;
}

void Strip::set_columns(int columns) {
  if (columns == this->columns()) return;
  columns_.assign(static_cast<std::size_t>(columns), {});
  std::deque<Sample> all;
  all.swap(samples_);
  for (const Sample& sample : all) {
    add(sample);
    samples_.push_back(sample);
  }
}

StripColumn Strip::extent() const noexcept {
  StripColumn all;
  for (const StripColumn& column : columns_) {
    if (column.count == 0) continue;
    const std::uint32_t before = all.count;
    if (before == 0) all = column;
    all.min = std::min(all.min, column.min);
    all.max = std::max(all.max, column.max);
    all.count = before + column.count;
  }
  return all;
}

}  // namespace gearshift::ui
