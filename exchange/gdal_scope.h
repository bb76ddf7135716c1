// GDAL's objects and messages, kept to a scope.
#pragma once

#include <memory>
#include <string>

class GDALDataset;

namespace bosquet::exchange {

/// While it lives, GDAL's messages on this thread go nowhere; its last words go into ours.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  /// ": what GDAL said last", or nothing.
  static std::string last();
};

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const;
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

}  // namespace bosquet::exchange
