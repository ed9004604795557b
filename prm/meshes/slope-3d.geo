// Unstructured tetrahedra of size 2 in the box [0, 18] x [0, 25] x [0, 6]: gmsh -3 slope-3d.geo
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 18, 25, 6};
Physical Surface(1) = {1, 2, 3, 4, 5, 6};
Physical Volume(0) = {1};
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;
Mesh.Optimize = 1;
Mesh.MshFileVersion = 2.2;
