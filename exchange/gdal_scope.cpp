#include "exchange/gdal_scope.h"

#include <cpl_error.h>
#include <gdal.h>

namespace bosquet::exchange {

GdalMessages::GdalMessages() {
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
}

GdalMessages::~GdalMessages() { CPLPopErrorHandler(); }

std::string GdalMessages::last() {
  const char* text = CPLGetLastErrorMsg();
  return text && *text ? std::string(": ") + text : std::string();
}

void DatasetCloser::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

}  // namespace bosquet::exchange
