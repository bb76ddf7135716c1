// GDAL's objects and messages, kept to a scope.
//
// Header    names GDAL's types only; whoever lets a Dataset go includes gdal_priv.h
#pragma once

#include <cpl_error.h>
#include <gdal.h>

#include <memory>
#include <string>

class GDALDataset;

namespace bosquet::exchange {

/// While it lives, GDAL's messages on this thread go nowhere; its last words go into ours.
class GdalMessages {
 public:
  GdalMessages() {
    CPLErrorReset();
    CPLPushErrorHandler(CPLQuietErrorHandler);
  }
  ~GdalMessages() { CPLPopErrorHandler(); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  /// ": what GDAL said last", or nothing.
  static std::string last() {
    const char* text = CPLGetLastErrorMsg();
    return text && *text ? std::string(": ") + text : std::string();
  }
};

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

}  // namespace bosquet::exchange
