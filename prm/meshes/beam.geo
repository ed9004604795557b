// Unstructured triangles of size 1 in the rectangle [0, 18] x [0, 6]: gmsh -2 beam.geo
Point(1) = {0, 0, 0, 1}; Point(2) = {18, 0, 0, 1}; Point(3) = {18, 6, 0, 1}; Point(4) = {0, 6, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve(1) = {1, 2, 3, 4};
Physical Surface(0) = {1};
Mesh.Algorithm = 6;
Mesh.MshFileVersion = 2.2;
