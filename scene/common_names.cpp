#include "scene/common_names.h"

#include <array>

namespace bosquet::scene {
namespace {

constexpr std::array kNames{
    CommonNames{"common_hazel",
                "haselnuss;gemeinehasel;haselstrauch;waldhasel;noisetier;noisetiercommun;coudrier;hazelnut;"
                "europeanhazel;corylusavellanacontorta;korkenzieherhasel",
                "hasel", "noisetier;coudrier"},
    CommonNames{"english_oak",
                "stieleiche;sommereiche;deutscheeiche;chenepedoncule;chenecommun;europeanoak;quercuspedunculata;"
                "saeuleneiche;pyramideneiche;cypressoak;chenefastigie",
                "eiche", "chene"},
    CommonNames{"european_beech",
                "rotbuche;gemeinebuche;blutbuche;haengebuche;saeulenbuche;trauerbuche;hetrecommun;hetrepourpre;"
                "hetrepleureur;copperbeech;purplebeech;weepingbeech;dawyckbeech;fayard",
                "buche", "hetre"},
    CommonNames{"field_elm",
                "feldulme;feldruester;ormechampetre;petitorme;ormeau;ulmuscarpinifolia;ulmuscampestris;ulmusprocera;"
                "englishelm;wheatleyelm;goldulme",
                "ulme;ruester", "orme"},
    CommonNames{"italian_cypress",
                "mittelmeerzypresse;saeulenzypresse;echtezypresse;italienischezypresse;cypresditalie;cypresdeprovence;"
                "cyprestoujoursvert;cypresdeflorence;funeralcypress;graveyardcypress;cypres",
                "zypresse", "cypres"},
    CommonNames{"lombardy_poplar",
                "pyramidenpappel;saeulenpappel;italienischepappel;spitzpappel;peuplierditalie;peupliernoirditalie;"
                "populusnigraitalica;populusitalica;populuspyramidalis;populusnigravaritalica",
                "pappel", "peuplier"},
    CommonNames{"london_plane",
                "ahornblaettrigeplatane;gemeineplatane;gewoehnlicheplatane;platanecommun;platanecommune;"
                "plataneafeuillesderable;platanushispanica;platanusacerifolia;platanusxacerifolia;platanushybrida;"
                "platanusxhybrida;bastardplatane",
                "platane", "platane"},
    CommonNames{"norway_maple",
                "spitzahorn;spitzblaettrigerahorn;blutahorn;kugelahorn;erableplane;norwegianmaple;crimsonkingmaple;"
                "globemaple;erableplaneglobuleux",
                "ahorn", "erable"},
    CommonNames{"norway_spruce",
                "rotfichte;gemeinefichte;gewoehnlichefichte;rottanne;epicea;epiceacommun;sapinrouge;piceaexcelsa;"
                "christmastree;pesse",
                "fichte", "epicea"},
    CommonNames{"olive", "olivenbaum;oelbaum;echteroelbaum;olivier;oliviereuropeen;oleaeuropaeavareuropaea", "oelbaum",
                "olivier;olea"},
    CommonNames{"rowan",
                "eberesche;vogelbeere;vogelbeerbaum;gemeineeberesche;edeleberesche;sorbierdesoiseleurs;"
                "sorbierdesoiseaux;quickbeam;europeanmountainash",
                "eberesche;vogelbeere;mehlbeere;elsbeere", "sorbier;alisier;whitebeam"},
    CommonNames{"scots_pine",
                "waldkiefer;gemeinekiefer;gewoehnlichekiefer;rotfoehre;weissfoehre;foehre;forle;pinsylvestre;"
                "scotchpine;redpine;waldfoehre",
                "kiefer;foehre", "pin"},
    CommonNames{"silver_birch",
                "haengebirke;sandbirke;weissbirke;gemeinebirke;warzenbirke;bouleaupleureur;bouleauverruqueux;"
                "bouleaublanc;bouleaucommun;europeanbirch;weepingbirch;betulaverrucosa;betulaalba",
                "birke", "bouleau"},
    CommonNames{
        "small_leaved_lime",
        "winterlinde;kleinblaettrigelinde;stadtlinde;amerikanischestadtlinde;steinlinde;tilleulapetitesfeuilles;"
        "tilleulcordata;tilleuldesbois;tilleuldhiver;tiliaparvifolia;smallleavedlinden;littleleaflime",
        "linde", "tilleul"},
    CommonNames{"weeping_willow",
                "trauerweide;haengeweide;goldtrauerweide;saulepleureur;saulepleureurdore;salixchrysocoma;"
                "salixsepulcralis;salixalbatristis;salixtristis;salixalbavitellinapendula;salixxchrysocoma;"
                "salixbabylonica;babylonweepingwillow",
                "weide", "saule"},
    CommonNames{"wild_cherry",
                "vogelkirsche;suesskirsche;wildkirsche;waldkirsche;merisier;cerisiersauvage;cerisierdesoiseaux;"
                "merisierdesoiseaux;prunusaviumplena;doublegean;cerasusavium",
                "kirsche", "merisier;cerisier"}};

}  // namespace

std::span<const CommonNames> common_names() { return kNames; }

std::string_view misleading_names() {
  return "hainbuche;hagebuche;weissbuche;hopfenbuche;suedbuche;scheinbuche;hornbeam;kornelkirsche;corneliancherry;"
         "scheinzypresse;sumpfzypresse;bastardzypresse;leylandzypresse;falsecypress;baldcypress;swampcypress;"
         "leylandcypress;cypreschauve;fauxcypres;oelweide;tulippoplar;yellowpoplar;russianolive;autumnolive;"
         "fragrantolive;teaolive;witchhazel;zauberhasel;scheinhasel;sheoak;silkoak;silkyoak;poisonoak;tanoak;keylime;"
         "persianlime;desertwillow;norfolkislandpine;norfolkpine;bunyapine;hooppine;umbrellapine;wasserulme;boxelder";
}

std::string_view conifer_words() {
  return "pine;spruce;fir;larch;cedar;juniper;yew;hemlock;redwood;sequoia;conifer;softwood;abies;larix;cedrus;"
         "juniperus;"
         "pseudotsuga;taxus;thuja;tsuga;chamaecyparis;taxodium;sequoiadendron;metasequoia;cupressocyparis;calocedrus;"
         "cryptomeria;pinus;picea;araucaria;sapin;meleze;cedre;genevrier;if;conifere;resineux;douglasie";
}

std::string_view conifer_compounds() {
  return "tanne;laerche;zeder;wacholder;eibe;nadelbaum;nadelholz;lebensbaum;mammutbaum;scheinzypresse;sumpfzypresse";
}

std::string_view columnar_words() {
  return "fastigiata;fastigiate;fastigie;fastigiatakoster;koster;columnaris;columnare;columna;dawyck;dawyckpurple;"
         "dawyckgold;olmsted;saeuleneiche;pyramideneiche;saeulenbuche;saeulenahorn;saeulenhainbuche;cypressoak;"
         "chenefastigie;dawyckbeech";
}

}  // namespace bosquet::scene
