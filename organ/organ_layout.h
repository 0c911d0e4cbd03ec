// The names inside an organ file: docs/notation.md has the symbols, this is where they lie.
#pragma once

namespace omentum::organ::layout {

// Attributes of the root group.
inline constexpr const char* kFormat = "format";      // kFormatName
inline constexpr const char* kVersion = "version";    // kFormatVersion (organ_hash.h)
inline constexpr const char* kFinished = "finished";  // written last: a file without it is not whole
inline constexpr const char* kHash = "hash";          // organ_hash()
inline constexpr const char* kStorage = "storage";    // "float" or "double"
inline constexpr const char* kName = "name";
inline constexpr const char* kYoung = "young_pa";
inline constexpr const char* kPoisson = "poisson";
inline constexpr const char* kDensity = "density_kg_m3";
inline constexpr const char* kFileNodes = "file_node_count";
inline constexpr const char* kMobile = "mobile_count";
inline constexpr const char* kChecksum = "tensors_xxh3";  // TensorChecksum over kBounds, then kCompliance

inline constexpr const char* kFormatName = "omentum organ";

// Datasets.
inline constexpr const char* kPositions = "mesh/positions";                     // [N][3] double, m
inline constexpr const char* kTetrahedra = "mesh/tetrahedra";                   // [T][4] int32
inline constexpr const char* kFileNode = "mesh/file_node";                      // [N] int32
inline constexpr const char* kNodeNumbers = "mesh/node_numbers";                // [file_node_count] int64
inline constexpr const char* kTetrahedronNumbers = "mesh/tetrahedron_numbers";  // [T] int64
inline constexpr const char* kMerged = "mesh/merged";  // [M][2] int32: dropped, kept; absent without any
// Of a hybrid organ; absent in others.
inline constexpr const char* kDynamic = "mesh/dynamic";  // [T] uint8, 1: of the dynamic part
inline constexpr const char* kBorder =
    "mesh/border";  // [B][3] int32: faces of either part on the other one; absent where parts share nodes
inline constexpr const char* kTensorNode =
    "tensors/node";  // [mobile] int32: mesh nodes of the part's tensors
// Of an organ with regions of their own material; absent without any.
inline constexpr const char* kRegions = "mesh/regions";              // [T] int32, a label each
inline constexpr const char* kRegionLabels = "material/labels";      // [R] int32, ascending
inline constexpr const char* kRegionMaterials = "material/regions";  // [R][3] double: Pa, -, kg/m^3
inline constexpr const char* kSurfaceNode = "surface/node";          // [S] int32
inline constexpr const char* kTriangles = "surface/triangles";       // [F][3] int32
inline constexpr const char* kBehind = "surface/tetrahedron";        // [F] int32
inline constexpr const char* kFanStart = "surface/fan_start";        // [S+1] int32
inline constexpr const char* kFan = "surface/fan";                   // [3F] int32
inline constexpr const char* kFixed = "supports/fixed";              // [N] uint8
// mobile: nodes of the whole surface, or of the precomputed part's own (tensors/node).
inline constexpr const char* kCompliance =
    "tensors/compliance";                                 // [mobile][clusters][9][16] float or double, m/N
inline constexpr const char* kBounds = "tensors/bounds";  // [mobile][clusters] float, m/N

}  // namespace omentum::organ::layout
