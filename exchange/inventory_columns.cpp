#include "exchange/inventory_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/letters.h"

namespace bosquet::exchange {
namespace {

using Names = std::span<const std::string_view>;

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array kUnits{
    Unit{"m", 1},         Unit{"cm", 0.01},          Unit{"mm", 0.001},         Unit{"in", 0.0254},
    Unit{"ft", 0.3048},   Unit{"inch", 0.0254},      Unit{"inches", 0.0254},    Unit{"feet", 0.3048},
    Unit{"foot", 0.3048}, Unit{"metres", 1},         Unit{"meters", 1},         Unit{"metre", 1},
    Unit{"meter", 1},     Unit{"centimetres", 0.01}, Unit{"centimeters", 0.01}, Unit{"zentimeter", 0.01},
    Unit{"zoll", 0.0254}, Unit{"fuss", 0.3048},      Unit{"pouces", 0.0254},    Unit{"pieds", 0.3048}};

constexpr std::string_view kEast[]{"x",     "east",       "easting", "e",       "x_coord",      "coord_x",     "xcoord",
                                   "utm_x", "rechtswert", "ostwert", "ost",     "x_koordinate", "e_lv95",      "x_utm",
                                   "est",   "coord_est",  "coordx",  "point_x", "x_coordinate", "koordinate_x"};
constexpr std::string_view kNorth[]{"y",       "north",        "northing",     "n",           "y_coord",
                                    "coord_y", "ycoord",       "utm_y",        "hochwert",    "nordwert",
                                    "nord",    "y_koordinate", "n_lv95",       "y_utm",       "coord_nord",
                                    "coordy",  "point_y",      "y_coordinate", "koordinate_y"};
constexpr std::string_view kLongitude[]{"lon",       "longitude", "lng",           "long",    "laenge",  "laengengrad",
                                        "lon_wgs84", "wgs84_lon", "longitude_deg", "lon_deg", "geo_lon", "x_wgs84"};
constexpr std::string_view kLatitude[]{"lat",       "latitude",     "breite",  "breitengrad", "lat_wgs84",
                                       "wgs84_lat", "latitude_deg", "lat_deg", "geo_lat",     "y_wgs84"};
constexpr std::string_view kSpecies[]{"botanical_name",   "scientific_name",
                                      "latin_name",       "species_latin",
                                      "species",          "species_name",
                                      "tree_species",     "taxon",
                                      "botanischer_name", "bot_name",
                                      "botanical",        "gattung_art",
                                      "art_bot",          "baumart_botanisch",
                                      "baumart_lat",      "baumart",
                                      "baumart_deutsch",  "art",
                                      "nom_scientifique", "nom_latin",
                                      "nom_botanique",    "espece",
                                      "essence",          "nom_francais",
                                      "libelle_francais", "libellefrancais",
                                      "common_name",      "common",
                                      "deutscher_name",   "genus",
                                      "gattung",          "genre",
                                      "blockname",        "layer"};
constexpr std::string_view kHeight[]{"height", "tree_height", "total_height", "h",         "baumhoehe",
                                     "hoehe",  "gesamthoehe", "height_tot",   "hauteur",   "hauteur_totale",
                                     "ht",     "height_m_",   "baum_hoehe",   "hauteurenm"};
constexpr std::string_view kTrunk[]{"dbh",
                                    "diameter",
                                    "trunk_diameter",
                                    "stem_diameter",
                                    "diam",
                                    "trunk",
                                    "diameter_at_breast_height",
                                    "bhd",
                                    "brusthoehendurchmesser",
                                    "stammdurchmesser",
                                    "stammdurchm",
                                    "stamm_d",
                                    "durchmesser",
                                    "diametre",
                                    "diametre_tronc",
                                    "diametre_du_tronc",
                                    "dhp",
                                    "dbh_trunk"};
constexpr std::string_view kGirth[]{"girth",
                                    "circumference",
                                    "trunk_circumference",
                                    "gbh",
                                    "cbh",
                                    "trunk_girth",
                                    "stammumfang",
                                    "stammumf",
                                    "umfang",
                                    "stu",
                                    "circonference",
                                    "circonference_tronc",
                                    "circonference_du_tronc",
                                    "circonferenceencm",
                                    "stem_girth"};
constexpr std::string_view kCrown[]{"crown_diameter",
                                    "crown_width",
                                    "crown_spread",
                                    "crown",
                                    "spread",
                                    "canopy_spread",
                                    "crown_diam",
                                    "canopy_diameter",
                                    "kronendurchmesser",
                                    "kronendurchm",
                                    "kronenbreite",
                                    "krone_d",
                                    "kronendm",
                                    "diametre_couronne",
                                    "diametre_houppier",
                                    "diametre_de_couronne",
                                    "envergure",
                                    "houppier"};
constexpr std::string_view kId[]{"id",         "tree_id", "treeid", "tree_no",     "tree_number", "tag",  "tree_tag",
                                 "baumnummer", "baum_nr", "baumnr", "baum_id",     "nummer",      "nr",   "no",
                                 "objectid",   "numero",  "num",    "identifiant", "idbase",      "code", "fid"};
constexpr std::string_view kStatus[]{"status", "tree_status", "zustand_planung", "planung",    "massnahme",
                                     "statut", "action",      "proposal",        "baumstatus", "etat_projet"};
constexpr std::string_view kClearStem[]{"clear_stem",        "clear_stem_height",     "clear_trunk",     "crown_base",
                                        "crown_base_height", "clear_stem_ht",         "height_to_crown", "clear_bole",
                                        "kronenansatz",      "kronenansatzhoehe",     "stammhoehe",      "lichte_hoehe",
                                        "hauteur_fut",       "hauteur_sous_couronne", "hauteur_du_fut",  "clear"};
constexpr std::string_view kAge[]{"age",       "age_years",  "tree_age",    "alter",
                                  "baumalter", "standalter", "alter_jahre", "age_ans"};

Names usual_names(InventoryField field) {
  switch (field) {
    case InventoryField::east:
      return kEast;
    case InventoryField::north:
      return kNorth;
    case InventoryField::species:
      return kSpecies;
    case InventoryField::height:
      return kHeight;
    case InventoryField::trunk_diameter:
      return kTrunk;
    case InventoryField::crown_diameter:
      return kCrown;
    case InventoryField::id:
      return kId;
    case InventoryField::status:
      return kStatus;
    case InventoryField::clear_stem:
      return kClearStem;
    case InventoryField::age:
      return kAge;
  }
  return {};
}

bool among(std::string_view name, Names names) { return std::find(names.begin(), names.end(), name) != names.end(); }

// A column's folded name without the unit at its end, which goes into `column`.
std::string without_unit(const std::string& name, FoundColumn& column) {
  const auto cut = name.rfind('_');
  if (cut == std::string::npos || cut == 0) return name;
  const auto metres = metres_of_unit(std::string_view(name).substr(cut + 1));
  if (!metres) return name;
  column.metres = *metres, column.has_unit = true;
  return name.substr(0, cut);
}

// Usual names may come with a unit; whether a column bears one.
bool bears(const std::string& folded, std::string_view wanted, FoundColumn& column) {
  column = {};
  if (folded == wanted) return true;  // the whole name is meant, not a unit at its end
  return without_unit(folded, column) == wanted;
}

FoundColumn find(const std::vector<std::string>& folded, Names usual) {
  for (const std::string_view wanted : usual)
    for (std::size_t i = 0; i < folded.size(); ++i) {
      FoundColumn column;
      if (!bears(folded[i], wanted, column)) continue;
      column.index = static_cast<int>(i);
      return column;
    }
  return {};
}

int find_exactly(const std::vector<std::string>& folded, std::initializer_list<std::string_view> names) {
  for (std::size_t i = 0; i < folded.size(); ++i)
    if (std::find(names.begin(), names.end(), folded[i]) != names.end()) return static_cast<int>(i);
  return -1;
}

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

std::string& InventoryColumns::operator[](InventoryField field) {
  std::string* const all[]{&east,           &north, &species, &height,     &trunk_diameter,
                           &crown_diameter, &id,    &status,  &clear_stem, &age};
  return *all[static_cast<std::size_t>(field)];
}
const std::string& InventoryColumns::operator[](InventoryField field) const {
  return const_cast<InventoryColumns&>(*this)[field];
}

std::optional<double> metres_of_unit(std::string_view unit) {
  for (const Unit& known : kUnits)
    if (known.name == unit) return known.metres;
  return {};
}

Result<FoundColumns> find_columns(const std::vector<std::string>& names, const InventoryColumns& given,
                                  const InventoryUnits& units, bool positions_needed, const std::string& file) {
  std::vector<std::string> folded;
  for (const std::string& name : names) folded.push_back(folded_words(name));

  FoundColumns out;
  for (std::size_t f = 0; f < kInventoryFields; ++f) {
    const auto field = static_cast<InventoryField>(f);
    const std::string& wanted = given[field];
    if (wanted.empty()) {
      out[field] = find(folded, usual_names(field));
      continue;
    }
    const auto at = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return name == wanted || folded_words(name) == folded_words(wanted);
    });
    if (at == names.end())
      return Error{fmt::format("{}: there is no column \"{}\" for {}; the columns are {}", file, wanted,
                               kInventoryFieldNames[f], list(names))};
    const auto i = static_cast<std::size_t>(at - names.begin());
    FoundColumn column;
    const std::string stem = without_unit(folded[i], column);
    column.index = static_cast<int>(i);
    column.girth = among(stem, kGirth);
    column.degrees = among(folded[i], kLongitude) || among(folded[i], kLatitude);
    out[field] = column;
  }
  if (out[InventoryField::trunk_diameter].index < 0) {
    out[InventoryField::trunk_diameter] = find(folded, kGirth);
    out[InventoryField::trunk_diameter].girth = true;
  }
  // A single h, e or n beside nothing else like it is too little to tell; positions come in pairs.
  FoundColumn &east = out[InventoryField::east], &north = out[InventoryField::north];
  if (given.east.empty() && given.north.empty() && (east.index < 0 || north.index < 0)) {
    east = find(folded, kLongitude), north = find(folded, kLatitude);
    east.degrees = north.degrees = true;
  }
  if (positions_needed && (east.index < 0 || north.index < 0))
    return Error{
        fmt::format("{}: no columns for the position found among {}; usual names are x_m and y_m, or lon and lat", file,
                    list(names))};
  if (east.degrees != north.degrees && east.index >= 0 && north.index >= 0)
    return Error{fmt::format("{}: position {} and {}: one is in degrees, the other is not", file,
                             names[static_cast<std::size_t>(east.index)],
                             names[static_cast<std::size_t>(north.index)])};

  const std::pair<InventoryField, const std::string*> said[]{{InventoryField::east, &units.position},
                                                             {InventoryField::north, &units.position},
                                                             {InventoryField::height, &units.height},
                                                             {InventoryField::trunk_diameter, &units.trunk_diameter},
                                                             {InventoryField::crown_diameter, &units.crown_diameter},
                                                             {InventoryField::clear_stem, &units.clear_stem}};
  for (const auto& [field, unit] : said) {
    if (unit->empty()) continue;
    const auto metres = metres_of_unit(*unit);
    if (!metres) return Error{fmt::format("unit '{}' is none of m, cm, mm, in, ft", *unit)};
    out[field].metres = *metres, out[field].has_unit = true;
  }

  out.inventory_name = find_exactly(folded, {"inventory_name", "inv_name"});
  out.inventory_id = find_exactly(folded, {"inventory_id", "inv_id"});
  out.surveyed = find_exactly(folded, {"surveyed"});
  if (given.species.empty()) {
    const int species = out[InventoryField::species].index;
    out.genus = find_exactly(folded, {"genus", "gattung", "genre"});
    out.cultivar = find_exactly(folded, {"cultivar", "sorte", "variete", "varieteoucultivar"});
    if (out.genus == species) out.genus = -1;
  }
  return out;
}

}  // namespace bosquet::exchange
