#include "app/runtime/stream_thread.h"

#include <stop_token>
#include <utility>

namespace gearshift::runtime {

StreamThread::StreamThread(const CycleStream& stream, std::chrono::microseconds every, AtEnd at_end,
                           std::function<void(const CycleRecord&)> use)
    : thread_([reader = CycleStream::Reader(stream), every, at_end,
               use = std::move(use)](const std::stop_token& stop) mutable {
        for (CycleRecord record;;) {
          const bool is_stopping = stop.stop_requested();
          if (is_stopping && at_end == AtEnd::stop) return;
          if (reader.pop(record))
            use(record);
          else if (is_stopping)
            return;
          else
            std::this_thread::sleep_for(every);
        }
      }) {}

}  // namespace gearshift::runtime
