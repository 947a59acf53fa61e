#pragma once

#include <array>

#include <imgui.h>

/// Icons as UTF-8 text, drawn by the font that loadFonts() merges Material Design Icons 1.6.50 into. They read well at
/// the size of the text beside them: `ImGui::Text("%s  %s", icon::kSave, "Save")`.
namespace sward::editor::icon {

inline constexpr char kNew[] = "\xEF\x88\x99";           // file-document, U+F219
inline constexpr char kFile[] = "\xEF\x88\x94";          // file, U+F214
inline constexpr char kFolder[] = "\xEF\x89\x8B";        // folder, U+F24B
inline constexpr char kFolderNew[] = "\xEF\x89\x97";     // folder-plus, U+F257
inline constexpr char kFolderUp[] = "\xEF\x81\x9D";      // arrow-up, U+F05D
inline constexpr char kSave[] = "\xEF\x86\x93";          // content-save, U+F193
inline constexpr char kSaveAs[] = "\xEF\x86\x94";        // content-save-all, U+F194
inline constexpr char kImport[] = "\xEF\x8B\xBA";        // import, U+F2FA
inline constexpr char kExport[] = "\xEF\x88\x87";        // export, U+F207
inline constexpr char kCopy[] = "\xEF\x86\x8F";          // content-copy, U+F18F
inline constexpr char kPaste[] = "\xEF\x86\x92";         // content-paste, U+F192
inline constexpr char kDuplicate[] = "\xEF\x86\x91";     // content-duplicate, U+F191
inline constexpr char kUndo[] = "\xEF\x95\x8C";          // undo, U+F54C
inline constexpr char kRedo[] = "\xEF\x91\x8E";          // redo, U+F44E
inline constexpr char kReset[] = "\xEF\x95\x8D";         // undo-variant, U+F54D
inline constexpr char kDelete[] = "\xEF\x87\x80";        // delete, U+F1C0
inline constexpr char kAdd[] = "\xEF\x90\x95";           // plus, U+F415
inline constexpr char kRemove[] = "\xEF\x8D\xB4";        // minus, U+F374
inline constexpr char kClose[] = "\xEF\x85\x96";         // close, U+F156
inline constexpr char kCheck[] = "\xEF\x84\xAC";         // check, U+F12C
inline constexpr char kSearch[] = "\xEF\x8D\x89";        // magnify, U+F349
inline constexpr char kSettings[] = "\xEF\x92\x93";      // settings, U+F493
inline constexpr char kTune[] = "\xEF\x98\xAE";          // tune, U+F62E
inline constexpr char kRefresh[] = "\xEF\x91\x90";       // refresh, U+F450
inline constexpr char kHistory[] = "\xEF\x8B\x9A";       // history, U+F2DA
inline constexpr char kCamera[] = "\xEF\x84\x80";        // camera, U+F100
inline constexpr char kImage[] = "\xEF\x8B\xA9";         // image, U+F2E9
inline constexpr char kMissingImage[] = "\xEF\x8B\xAD";  // image-broken, U+F2ED
inline constexpr char kFilm[] = "\xEF\x95\xA7";          // video, U+F567
inline constexpr char kSun[] = "\xEF\x96\x99";           // weather-sunny, U+F599
inline constexpr char kSunset[] = "\xEF\x96\x9A";        // weather-sunset, U+F59A
inline constexpr char kNight[] = "\xEF\x96\x94";         // weather-night, U+F594
inline constexpr char kSky[] = "\xEF\x96\x95";           // weather-partlycloudy, U+F595
inline constexpr char kLeaf[] = "\xEF\x8C\xAA";          // leaf, U+F32A
inline constexpr char kFlower[] = "\xEF\x89\x8A";        // flower, U+F24A
inline constexpr char kTree[] = "\xEF\x94\xB1";          // tree, U+F531
inline constexpr char kForest[] = "\xEF\x90\x85";        // pine-tree, U+F405
inline constexpr char kTerrain[] = "\xEF\x94\x89";       // terrain, U+F509
inline constexpr char kTexture[] = "\xEF\x94\x8C";       // texture, U+F50C
inline constexpr char kModel[] = "\xEF\x86\xA7";         // cube-outline, U+F1A7
inline constexpr char kLayers[] = "\xEF\x8C\xA8";        // layers, U+F328
inline constexpr char kLight[] = "\xEF\x8C\xB6";         // lightbulb-outline, U+F336
inline constexpr char kPalette[] = "\xEF\x8F\x98";       // palette, U+F3D8
inline constexpr char kCurve[] = "\xEF\x95\x99";         // vector-curve, U+F559
inline constexpr char kChart[] = "\xEF\x84\xAA";         // chart-line, U+F12A
inline constexpr char kEye[] = "\xEF\x88\x88";           // eye, U+F208
inline constexpr char kEyeOff[] = "\xEF\x88\x89";        // eye-off, U+F209
inline constexpr char kLock[] = "\xEF\x8C\xBE";          // lock, U+F33E
inline constexpr char kUnlock[] = "\xEF\x8D\x80";        // lock-open-outline, U+F340
inline constexpr char kPlay[] = "\xEF\x90\x8A";          // play, U+F40A
inline constexpr char kPause[] = "\xEF\x8F\xA4";         // pause, U+F3E4
inline constexpr char kStop[] = "\xEF\x93\x9B";          // stop, U+F4DB
inline constexpr char kNext[] = "\xEF\x92\xAD";          // skip-next, U+F4AD
inline constexpr char kPrevious[] = "\xEF\x92\xAE";      // skip-previous, U+F4AE
inline constexpr char kAlert[] = "\xEF\x80\xA6";         // alert, U+F026
inline constexpr char kError[] = "\xEF\x80\xA8";         // alert-circle, U+F028
inline constexpr char kInfo[] = "\xEF\x8B\xBC";          // information, U+F2FC
inline constexpr char kDone[] = "\xEF\x97\xA0";          // check-circle, U+F5E0
inline constexpr char kHelp[] = "\xEF\x98\xA5";          // help-circle-outline, U+F625
inline constexpr char kLeft[] = "\xEF\x81\x8D";          // arrow-left, U+F04D
inline constexpr char kRight[] = "\xEF\x81\x94";         // arrow-right, U+F054
inline constexpr char kUp[] = "\xEF\x81\x9D";            // arrow-up, U+F05D
inline constexpr char kDown[] = "\xEF\x81\x85";          // arrow-down, U+F045
inline constexpr char kChevronRight[] = "\xEF\x85\x82";  // chevron-right, U+F142
inline constexpr char kChevronDown[] = "\xEF\x85\x80";   // chevron-down, U+F140
inline constexpr char kChevronUp[] = "\xEF\x85\x83";     // chevron-up, U+F143
inline constexpr char kHome[] = "\xEF\x8B\x9C";          // home, U+F2DC
inline constexpr char kGrid[] = "\xEF\x8B\x81";          // grid, U+F2C1
inline constexpr char kSnap[] = "\xEF\x8D\x87";          // magnet, U+F347
inline constexpr char kFrameAll[] = "\xEF\x86\x9F";      // crop-free, U+F19F
inline constexpr char kFullscreen[] = "\xEF\x8A\x93";    // fullscreen, U+F293
inline constexpr char kTarget[] = "\xEF\x93\xBE";        // target, U+F4FE
inline constexpr char kMove[] = "\xEF\x86\xB6";          // cursor-move, U+F1B6
inline constexpr char kPointer[] = "\xEF\x86\xB4";       // cursor-default, U+F1B4
inline constexpr char kCompare[] = "\xEF\x86\x8A";       // compare, U+F18A
inline constexpr char kViewGrid[] = "\xEF\x95\xB0";      // view-grid, U+F570
inline constexpr char kViewList[] = "\xEF\x95\xB2";      // view-list, U+F572
inline constexpr char kSortUp[] = "\xEF\x92\xBC";        // sort-ascending, U+F4BC
inline constexpr char kSortDown[] = "\xEF\x92\xBD";      // sort-descending, U+F4BD
inline constexpr char kMore[] = "\xEF\x87\x98";          // dots-horizontal, U+F1D8
inline constexpr char kMenu[] = "\xEF\x8D\x9C";          // menu, U+F35C
inline constexpr char kFilter[] = "\xEF\x88\xB6";        // filter-variant, U+F236
inline constexpr char kTimer[] = "\xEF\x94\x9F";         // timer-sand, U+F51F
inline constexpr char kMemory[] = "\xEF\x8D\x9B";        // memory, U+F35B
inline constexpr char kSpeed[] = "\xEF\x93\x85";         // speedometer, U+F4C5
inline constexpr char kKeyboard[] = "\xEF\x8C\x8C";      // keyboard, U+F30C
inline constexpr char kRename[] = "\xEF\x8F\xAB";        // pencil, U+F3EB
inline constexpr char kDice[] = "\xEF\x87\x8E";          // dice-5, U+F1CE
inline constexpr char kDisk[] = "\xEF\x8B\x8A";          // harddisk, U+F2CA
inline constexpr char kCompass[] = "\xEF\x86\x8C";       // compass-outline, U+F18C
inline constexpr char kTheme[] = "\xEF\x83\x9F";         // brightness-6, U+F0DF
inline constexpr char kPower[] = "\xEF\x90\xA5";         // power, U+F425

/// Code points of all of the above; the font atlas holds these alone of the seven hundred in the file.
inline constexpr std::array<ImWchar, 92> kCodePoints{
    0xF219, 0xF214, 0xF24B, 0xF257, 0xF05D, 0xF193, 0xF194, 0xF2FA, 0xF207, 0xF18F, 0xF192, 0xF191, 0xF54C, 0xF44E,
    0xF54D, 0xF1C0, 0xF415, 0xF374, 0xF156, 0xF12C, 0xF349, 0xF493, 0xF62E, 0xF450, 0xF2DA, 0xF100, 0xF2E9, 0xF2ED,
    0xF567, 0xF599, 0xF59A, 0xF594, 0xF595, 0xF32A, 0xF24A, 0xF531, 0xF405, 0xF509, 0xF50C, 0xF1A7, 0xF328, 0xF336,
    0xF3D8, 0xF559, 0xF12A, 0xF208, 0xF209, 0xF33E, 0xF340, 0xF40A, 0xF3E4, 0xF4DB, 0xF4AD, 0xF4AE, 0xF026, 0xF028,
    0xF2FC, 0xF5E0, 0xF625, 0xF04D, 0xF054, 0xF05D, 0xF045, 0xF142, 0xF140, 0xF143, 0xF2DC, 0xF2C1, 0xF347, 0xF19F,
    0xF293, 0xF4FE, 0xF1B6, 0xF1B4, 0xF18A, 0xF570, 0xF572, 0xF4BC, 0xF4BD, 0xF1D8, 0xF35C, 0xF236, 0xF51F, 0xF35B,
    0xF4C5, 0xF30C, 0xF3EB, 0xF1CE, 0xF2CA, 0xF18C, 0xF0DF, 0xF425};

}  // namespace sward::editor::icon
