(# A GEOM file #)
Material green {
    Ambient <30,90,60>
    Diffuse 1.5
}
Group plant {
    GeometryList [
        TriangleSet blade { CCW True PointList [ <0,0,1>, <2,0,1>, <0,2e0,1> ] IndexList [ [0,1,2] ] },
        Translated { Translation <1,0,0> Geometry QuadSet { PointList [<0,0,0>,<1,0,0>,<1,1,0>,<0,1,0>] IndexList [[0,1,2,3]] } },
        Scaled { Scale <1,2,-1> Geometry AxisRotated { Axis OZ Angle 30 Geometry blade } },
        EulerRotated { Azimuth 10 Elevation -20 Roll 3 Geometry Oriented { Primary <0,1,0> Secondary OZ Geometry FaceSet {
            PointList [<0,0,0>,<1,0,0>,<1,1,0>,<0,1,0>,<-1,.5,0>] IndexList [[0,1,2,3,4]] CCW False } } }
    ]
}
# a shape in many words, and one in few
Shape leaf_1 { Id 12 ParentId 3 Geometry plant Appearance green }
Shape { blade, Material { Ambient Red } }
