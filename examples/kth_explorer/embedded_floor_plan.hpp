/// The floor plan that the explorer runs on when no map is named: one floor of an office building of 55 x 25 m,
/// drawn for this project, in the XML format of the KTH campus data set (centimetres, y up).
#pragma once

namespace examples {

inline constexpr char embedded_floor_plan_xml[] = R"xml(<?xml version="1.0" encoding="UTF-8"?>
<floor BuildingName="incognita" FloorName="1">
  <Scale PixelDistance="1000" RealDistance="10"/>
  <space name="corridor" type="corridor">
    <contour>
      <centroid x="2750" y="1250"/>
      <linesegment x1="30" y1="1140" x2="205" y2="1140" type="Wall" target=""/>
      <linesegment x1="205" y1="1140" x2="295" y2="1140" type="Portal" target="office_1"/>
      <linesegment x1="295" y1="1140" x2="775" y2="1140" type="Wall" target=""/>
      <linesegment x1="775" y1="1140" x2="865" y2="1140" type="Portal" target="office_2"/>
      <linesegment x1="865" y1="1140" x2="1015" y2="1140" type="Wall" target=""/>
      <linesegment x1="1015" y1="1140" x2="1105" y2="1140" type="Portal" target="office_3"/>
      <linesegment x1="1105" y1="1140" x2="1585" y2="1140" type="Wall" target=""/>
      <linesegment x1="1585" y1="1140" x2="1675" y2="1140" type="Portal" target="office_4"/>
      <linesegment x1="1675" y1="1140" x2="1955" y2="1140" type="Wall" target=""/>
      <linesegment x1="1955" y1="1140" x2="2045" y2="1140" type="Portal" target="meeting"/>
      <linesegment x1="2045" y1="1140" x2="2700" y2="1140" type="Wall" target=""/>
      <linesegment x1="2700" y1="1140" x2="2900" y2="1140" type="Portal" target="corridor_south"/>
      <linesegment x1="2900" y1="1140" x2="3075" y2="1140" type="Wall" target=""/>
      <linesegment x1="3075" y1="1140" x2="3165" y2="1140" type="Portal" target="office_8"/>
      <linesegment x1="3165" y1="1140" x2="3915" y2="1140" type="Wall" target=""/>
      <linesegment x1="3915" y1="1140" x2="4005" y2="1140" type="Portal" target="office_10"/>
      <linesegment x1="4005" y1="1140" x2="4940" y2="1140" type="Wall" target=""/>
      <linesegment x1="4940" y1="1140" x2="5120" y2="1140" type="Portal" target="hall"/>
      <linesegment x1="5120" y1="1140" x2="5470" y2="1140" type="Wall" target=""/>
      <linesegment x1="5470" y1="1140" x2="5470" y2="1360" type="Wall" target=""/>
      <linesegment x1="5470" y1="1360" x2="5190" y2="1360" type="Wall" target=""/>
      <linesegment x1="5190" y1="1360" x2="5010" y2="1360" type="Portal" target="stairs"/>
      <linesegment x1="5010" y1="1360" x2="4625" y2="1360" type="Wall" target=""/>
      <linesegment x1="4625" y1="1360" x2="4535" y2="1360" type="Portal" target="server_room"/>
      <linesegment x1="4535" y1="1360" x2="4245" y2="1360" type="Wall" target=""/>
      <linesegment x1="4245" y1="1360" x2="4155" y2="1360" type="Portal" target="office_7"/>
      <linesegment x1="4155" y1="1360" x2="3575" y2="1360" type="Wall" target=""/>
      <linesegment x1="3575" y1="1360" x2="3485" y2="1360" type="Portal" target="office_6"/>
      <linesegment x1="3485" y1="1360" x2="3335" y2="1360" type="Wall" target=""/>
      <linesegment x1="3335" y1="1360" x2="3245" y2="1360" type="Portal" target="office_5"/>
      <linesegment x1="3245" y1="1360" x2="2900" y2="1360" type="Wall" target=""/>
      <linesegment x1="2900" y1="1360" x2="2700" y2="1360" type="Portal" target="corridor_north"/>
      <linesegment x1="2700" y1="1360" x2="2390" y2="1360" type="Wall" target=""/>
      <linesegment x1="2390" y1="1360" x2="2210" y2="1360" type="Portal" target="lounge"/>
      <linesegment x1="2210" y1="1360" x2="1595" y2="1360" type="Wall" target=""/>
      <linesegment x1="1595" y1="1360" x2="1505" y2="1360" type="Portal" target="kitchen"/>
      <linesegment x1="1505" y1="1360" x2="1160" y2="1360" type="Wall" target=""/>
      <linesegment x1="1160" y1="1360" x2="1040" y2="1360" type="Portal" target="lecture_hall"/>
      <linesegment x1="1040" y1="1360" x2="320" y2="1360" type="Wall" target=""/>
      <linesegment x1="320" y1="1360" x2="200" y2="1360" type="Portal" target="lecture_hall"/>
      <linesegment x1="200" y1="1360" x2="30" y2="1360" type="Wall" target=""/>
      <linesegment x1="30" y1="1360" x2="30" y2="1140" type="Wall" target=""/>
    </contour>
    <portal target="corridor_north"/>
    <portal target="corridor_south"/>
    <portal target="office_1"/>
    <portal target="office_2"/>
    <portal target="office_3"/>
    <portal target="office_4"/>
    <portal target="meeting"/>
    <portal target="lecture_hall"/>
    <portal target="lecture_hall"/>
    <portal target="kitchen"/>
    <portal target="lounge"/>
    <portal target="office_5"/>
    <portal target="office_6"/>
    <portal target="office_7"/>
    <portal target="server_room"/>
    <portal target="stairs"/>
    <portal target="office_8"/>
    <portal target="office_10"/>
    <portal target="hall"/>
  </space>
  <space name="corridor_north" type="corridor">
    <contour>
      <centroid x="2800" y="1925"/>
      <linesegment x1="2700" y1="1380" x2="2900" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="2900" y1="1380" x2="2900" y2="2040" type="Wall" target=""/>
      <linesegment x1="2900" y1="2040" x2="2900" y2="2160" type="Portal" target="open_office"/>
      <linesegment x1="2900" y1="2160" x2="2900" y2="2470" type="Wall" target=""/>
      <linesegment x1="2900" y1="2470" x2="2700" y2="2470" type="Wall" target=""/>
      <linesegment x1="2700" y1="2470" x2="2700" y2="2295" type="Wall" target=""/>
      <linesegment x1="2700" y1="2295" x2="2700" y2="2205" type="Portal" target="lounge"/>
      <linesegment x1="2700" y1="2205" x2="2700" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="lounge"/>
    <portal target="open_office"/>
  </space>
  <space name="corridor_south" type="corridor">
    <contour>
      <centroid x="2800" y="575"/>
      <linesegment x1="2700" y1="30" x2="2900" y2="30" type="Wall" target=""/>
      <linesegment x1="2900" y1="30" x2="2900" y2="480" type="Wall" target=""/>
      <linesegment x1="2900" y1="480" x2="2900" y2="680" type="Portal" target="passage"/>
      <linesegment x1="2900" y1="680" x2="2900" y2="1120" type="Wall" target=""/>
      <linesegment x1="2900" y1="1120" x2="2700" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="2700" y1="1120" x2="2700" y2="695" type="Wall" target=""/>
      <linesegment x1="2700" y1="695" x2="2700" y2="605" type="Portal" target="meeting"/>
      <linesegment x1="2700" y1="605" x2="2700" y2="245" type="Wall" target=""/>
      <linesegment x1="2700" y1="245" x2="2700" y2="155" type="Portal" target="storage"/>
      <linesegment x1="2700" y1="155" x2="2700" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="meeting"/>
    <portal target="storage"/>
    <portal target="passage"/>
  </space>
  <space name="office_1" type="office">
    <contour>
      <centroid x="250" y="870"/>
      <linesegment x1="30" y1="620" x2="470" y2="620" type="Wall" target=""/>
      <linesegment x1="470" y1="620" x2="470" y2="1120" type="Wall" target=""/>
      <linesegment x1="470" y1="1120" x2="295" y2="1120" type="Wall" target=""/>
      <linesegment x1="295" y1="1120" x2="205" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="205" y1="1120" x2="30" y2="1120" type="Wall" target=""/>
      <linesegment x1="30" y1="1120" x2="30" y2="620" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="office_2" type="office">
    <contour>
      <centroid x="710" y="870"/>
      <linesegment x1="490" y1="620" x2="665" y2="620" type="Wall" target=""/>
      <linesegment x1="665" y1="620" x2="755" y2="620" type="Portal" target="laboratory"/>
      <linesegment x1="755" y1="620" x2="930" y2="620" type="Wall" target=""/>
      <linesegment x1="930" y1="620" x2="930" y2="1120" type="Wall" target=""/>
      <linesegment x1="930" y1="1120" x2="865" y2="1120" type="Wall" target=""/>
      <linesegment x1="865" y1="1120" x2="775" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="775" y1="1120" x2="490" y2="1120" type="Wall" target=""/>
      <linesegment x1="490" y1="1120" x2="490" y2="620" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="laboratory"/>
  </space>
  <space name="office_3" type="office">
    <contour>
      <centroid x="1170" y="870"/>
      <linesegment x1="950" y1="620" x2="1390" y2="620" type="Wall" target=""/>
      <linesegment x1="1390" y1="620" x2="1390" y2="1120" type="Wall" target=""/>
      <linesegment x1="1390" y1="1120" x2="1105" y2="1120" type="Wall" target=""/>
      <linesegment x1="1105" y1="1120" x2="1015" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="1015" y1="1120" x2="950" y2="1120" type="Wall" target=""/>
      <linesegment x1="950" y1="1120" x2="950" y2="620" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="office_4" type="office">
    <contour>
      <centroid x="1630" y="870"/>
      <linesegment x1="1410" y1="620" x2="1455" y2="620" type="Wall" target=""/>
      <linesegment x1="1455" y1="620" x2="1545" y2="620" type="Portal" target="workshop"/>
      <linesegment x1="1545" y1="620" x2="1850" y2="620" type="Wall" target=""/>
      <linesegment x1="1850" y1="620" x2="1850" y2="1120" type="Wall" target=""/>
      <linesegment x1="1850" y1="1120" x2="1675" y2="1120" type="Wall" target=""/>
      <linesegment x1="1675" y1="1120" x2="1585" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="1585" y1="1120" x2="1410" y2="1120" type="Wall" target=""/>
      <linesegment x1="1410" y1="1120" x2="1410" y2="620" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="workshop"/>
  </space>
  <space name="meeting" type="meeting room">
    <contour>
      <centroid x="2275" y="760"/>
      <linesegment x1="1870" y1="400" x2="2680" y2="400" type="Wall" target=""/>
      <linesegment x1="2680" y1="400" x2="2680" y2="605" type="Wall" target=""/>
      <linesegment x1="2680" y1="605" x2="2680" y2="695" type="Portal" target="corridor_south"/>
      <linesegment x1="2680" y1="695" x2="2680" y2="1120" type="Wall" target=""/>
      <linesegment x1="2680" y1="1120" x2="2045" y2="1120" type="Wall" target=""/>
      <linesegment x1="2045" y1="1120" x2="1955" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="1955" y1="1120" x2="1870" y2="1120" type="Wall" target=""/>
      <linesegment x1="1870" y1="1120" x2="1870" y2="400" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="corridor_south"/>
  </space>
  <space name="laboratory" type="laboratory">
    <contour>
      <centroid x="660" y="315"/>
      <linesegment x1="30" y1="30" x2="1290" y2="30" type="Window" target=""/>
      <linesegment x1="1290" y1="30" x2="1290" y2="160" type="Wall" target=""/>
      <linesegment x1="1290" y1="160" x2="1290" y2="280" type="Portal" target="workshop"/>
      <linesegment x1="1290" y1="280" x2="1290" y2="600" type="Wall" target=""/>
      <linesegment x1="1290" y1="600" x2="755" y2="600" type="Wall" target=""/>
      <linesegment x1="755" y1="600" x2="665" y2="600" type="Portal" target="office_2"/>
      <linesegment x1="665" y1="600" x2="30" y2="600" type="Wall" target=""/>
      <linesegment x1="30" y1="600" x2="30" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="office_2"/>
    <portal target="workshop"/>
  </space>
  <space name="workshop" type="workshop">
    <contour>
      <centroid x="1580" y="315"/>
      <linesegment x1="1310" y1="30" x2="1850" y2="30" type="Wall" target=""/>
      <linesegment x1="1850" y1="30" x2="1850" y2="600" type="Wall" target=""/>
      <linesegment x1="1850" y1="600" x2="1545" y2="600" type="Wall" target=""/>
      <linesegment x1="1545" y1="600" x2="1455" y2="600" type="Portal" target="office_4"/>
      <linesegment x1="1455" y1="600" x2="1310" y2="600" type="Wall" target=""/>
      <linesegment x1="1310" y1="600" x2="1310" y2="280" type="Wall" target=""/>
      <linesegment x1="1310" y1="280" x2="1310" y2="160" type="Portal" target="laboratory"/>
      <linesegment x1="1310" y1="160" x2="1310" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="office_4"/>
    <portal target="laboratory"/>
  </space>
  <space name="storage" type="storage">
    <contour>
      <centroid x="2275" y="205"/>
      <linesegment x1="1870" y1="30" x2="2680" y2="30" type="Wall" target=""/>
      <linesegment x1="2680" y1="30" x2="2680" y2="155" type="Wall" target=""/>
      <linesegment x1="2680" y1="155" x2="2680" y2="245" type="Portal" target="corridor_south"/>
      <linesegment x1="2680" y1="245" x2="2680" y2="380" type="Wall" target=""/>
      <linesegment x1="2680" y1="380" x2="1870" y2="380" type="Wall" target=""/>
      <linesegment x1="1870" y1="380" x2="1870" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="corridor_south"/>
  </space>
  <space name="lecture_hall" type="lecture hall">
    <contour>
      <centroid x="667" y="2275"/>
      <linesegment x1="30" y1="1380" x2="200" y2="1380" type="Wall" target=""/>
      <linesegment x1="200" y1="1380" x2="320" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="320" y1="1380" x2="1040" y2="1380" type="Wall" target=""/>
      <linesegment x1="1040" y1="1380" x2="1160" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="1160" y1="1380" x2="1290" y2="1380" type="Wall" target=""/>
      <linesegment x1="1290" y1="1380" x2="1290" y2="2470" type="Wall" target=""/>
      <linesegment x1="1290" y1="2470" x2="900" y2="2470" type="Wall" target=""/>
      <linesegment x1="900" y1="2470" x2="900" y2="2430" type="Wall" target=""/>
      <linesegment x1="900" y1="2430" x2="860" y2="2430" type="Wall" target=""/>
      <linesegment x1="860" y1="2430" x2="860" y2="2470" type="Wall" target=""/>
      <linesegment x1="860" y1="2470" x2="480" y2="2470" type="Wall" target=""/>
      <linesegment x1="480" y1="2470" x2="480" y2="2430" type="Wall" target=""/>
      <linesegment x1="480" y1="2430" x2="440" y2="2430" type="Wall" target=""/>
      <linesegment x1="440" y1="2430" x2="440" y2="2470" type="Wall" target=""/>
      <linesegment x1="440" y1="2470" x2="30" y2="2470" type="Wall" target=""/>
      <linesegment x1="30" y1="2470" x2="30" y2="1380" type="Window" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="corridor"/>
  </space>
  <space name="kitchen" type="kitchen">
    <contour>
      <centroid x="1550" y="1610"/>
      <linesegment x1="1310" y1="1380" x2="1505" y2="1380" type="Wall" target=""/>
      <linesegment x1="1505" y1="1380" x2="1595" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="1595" y1="1380" x2="1790" y2="1380" type="Wall" target=""/>
      <linesegment x1="1790" y1="1380" x2="1790" y2="1840" type="Wall" target=""/>
      <linesegment x1="1790" y1="1840" x2="1735" y2="1840" type="Wall" target=""/>
      <linesegment x1="1735" y1="1840" x2="1645" y2="1840" type="Portal" target="library"/>
      <linesegment x1="1645" y1="1840" x2="1310" y2="1840" type="Wall" target=""/>
      <linesegment x1="1310" y1="1840" x2="1310" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="library"/>
  </space>
  <space name="library" type="library">
    <contour>
      <centroid x="1550" y="2165"/>
      <linesegment x1="1310" y1="1860" x2="1645" y2="1860" type="Wall" target=""/>
      <linesegment x1="1645" y1="1860" x2="1735" y2="1860" type="Portal" target="kitchen"/>
      <linesegment x1="1735" y1="1860" x2="1790" y2="1860" type="Wall" target=""/>
      <linesegment x1="1790" y1="1860" x2="1790" y2="2470" type="Wall" target=""/>
      <linesegment x1="1790" y1="2470" x2="1310" y2="2470" type="Window" target=""/>
      <linesegment x1="1310" y1="2470" x2="1310" y2="1860" type="Wall" target=""/>
    </contour>
    <portal target="kitchen"/>
  </space>
  <space name="lounge" type="lounge">
    <contour>
      <centroid x="2230" y="1903"/>
      <linesegment x1="1810" y1="1380" x2="2210" y2="1380" type="Wall" target=""/>
      <linesegment x1="2210" y1="1380" x2="2390" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="2390" y1="1380" x2="2680" y2="1380" type="Wall" target=""/>
      <linesegment x1="2680" y1="1380" x2="2680" y2="2205" type="Wall" target=""/>
      <linesegment x1="2680" y1="2205" x2="2680" y2="2295" type="Portal" target="corridor_north"/>
      <linesegment x1="2680" y1="2295" x2="2680" y2="2470" type="Wall" target=""/>
      <linesegment x1="2680" y1="2470" x2="2200" y2="2470" type="Wall" target=""/>
      <linesegment x1="2200" y1="2470" x2="2200" y2="2145" type="Wall" target=""/>
      <linesegment x1="2200" y1="2145" x2="2200" y2="2055" type="Portal" target="quiet_room"/>
      <linesegment x1="2200" y1="2055" x2="2200" y2="1860" type="Wall" target=""/>
      <linesegment x1="2200" y1="1860" x2="1810" y2="1860" type="Wall" target=""/>
      <linesegment x1="1810" y1="1860" x2="1810" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="quiet_room"/>
    <portal target="corridor_north"/>
  </space>
  <space name="quiet_room" type="office">
    <contour>
      <centroid x="1995" y="2175"/>
      <linesegment x1="1810" y1="1880" x2="2180" y2="1880" type="Wall" target=""/>
      <linesegment x1="2180" y1="1880" x2="2180" y2="2055" type="Wall" target=""/>
      <linesegment x1="2180" y1="2055" x2="2180" y2="2145" type="Portal" target="lounge"/>
      <linesegment x1="2180" y1="2145" x2="2180" y2="2470" type="Wall" target=""/>
      <linesegment x1="2180" y1="2470" x2="1810" y2="2470" type="Wall" target=""/>
      <linesegment x1="1810" y1="2470" x2="1810" y2="1880" type="Wall" target=""/>
    </contour>
    <portal target="lounge"/>
  </space>
  <space name="office_5" type="office">
    <contour>
      <centroid x="3160" y="1630"/>
      <linesegment x1="2920" y1="1380" x2="3245" y2="1380" type="Wall" target=""/>
      <linesegment x1="3245" y1="1380" x2="3335" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="3335" y1="1380" x2="3400" y2="1380" type="Wall" target=""/>
      <linesegment x1="3400" y1="1380" x2="3400" y2="1880" type="Wall" target=""/>
      <linesegment x1="3400" y1="1880" x2="2920" y2="1880" type="Wall" target=""/>
      <linesegment x1="2920" y1="1880" x2="2920" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="office_6" type="office">
    <contour>
      <centroid x="3660" y="1630"/>
      <linesegment x1="3420" y1="1380" x2="3485" y2="1380" type="Wall" target=""/>
      <linesegment x1="3485" y1="1380" x2="3575" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="3575" y1="1380" x2="3900" y2="1380" type="Wall" target=""/>
      <linesegment x1="3900" y1="1380" x2="3900" y2="1880" type="Wall" target=""/>
      <linesegment x1="3900" y1="1880" x2="3705" y2="1880" type="Wall" target=""/>
      <linesegment x1="3705" y1="1880" x2="3615" y2="1880" type="Portal" target="open_office"/>
      <linesegment x1="3615" y1="1880" x2="3420" y2="1880" type="Wall" target=""/>
      <linesegment x1="3420" y1="1880" x2="3420" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
    <portal target="open_office"/>
  </space>
  <space name="office_7" type="office">
    <contour>
      <centroid x="4160" y="1630"/>
      <linesegment x1="3920" y1="1380" x2="4155" y2="1380" type="Wall" target=""/>
      <linesegment x1="4155" y1="1380" x2="4245" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="4245" y1="1380" x2="4400" y2="1380" type="Wall" target=""/>
      <linesegment x1="4400" y1="1380" x2="4400" y2="1880" type="Wall" target=""/>
      <linesegment x1="4400" y1="1880" x2="3920" y2="1880" type="Wall" target=""/>
      <linesegment x1="3920" y1="1880" x2="3920" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="server_room" type="server room">
    <contour>
      <centroid x="4580" y="1630"/>
      <linesegment x1="4420" y1="1380" x2="4535" y2="1380" type="Wall" target=""/>
      <linesegment x1="4535" y1="1380" x2="4625" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="4625" y1="1380" x2="4740" y2="1380" type="Wall" target=""/>
      <linesegment x1="4740" y1="1380" x2="4740" y2="1880" type="Wall" target=""/>
      <linesegment x1="4740" y1="1880" x2="4420" y2="1880" type="Wall" target=""/>
      <linesegment x1="4420" y1="1880" x2="4420" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="open_office" type="office">
    <contour>
      <centroid x="3830" y="2185"/>
      <linesegment x1="2920" y1="1900" x2="3615" y2="1900" type="Wall" target=""/>
      <linesegment x1="3615" y1="1900" x2="3705" y2="1900" type="Portal" target="office_6"/>
      <linesegment x1="3705" y1="1900" x2="4740" y2="1900" type="Wall" target=""/>
      <linesegment x1="4740" y1="1900" x2="4740" y2="2235" type="Wall" target=""/>
      <linesegment x1="4740" y1="2235" x2="4740" y2="2325" type="Portal" target="stairs"/>
      <linesegment x1="4740" y1="2325" x2="4740" y2="2470" type="Wall" target=""/>
      <linesegment x1="4740" y1="2470" x2="2920" y2="2470" type="Window" target=""/>
      <linesegment x1="2920" y1="2470" x2="2920" y2="2160" type="Wall" target=""/>
      <linesegment x1="2920" y1="2160" x2="2920" y2="2040" type="Portal" target="corridor_north"/>
      <linesegment x1="2920" y1="2040" x2="2920" y2="1900" type="Wall" target=""/>
    </contour>
    <portal target="corridor_north"/>
    <portal target="office_6"/>
    <portal target="stairs"/>
  </space>
  <space name="stairs" type="stairs">
    <contour>
      <centroid x="5122" y="1970"/>
      <linesegment x1="4760" y1="1380" x2="5010" y2="1380" type="Wall" target=""/>
      <linesegment x1="5010" y1="1380" x2="5190" y2="1380" type="Portal" target="corridor"/>
      <linesegment x1="5190" y1="1380" x2="5470" y2="1380" type="Wall" target=""/>
      <linesegment x1="5470" y1="1380" x2="5470" y2="2150" type="Wall" target=""/>
      <linesegment x1="5470" y1="2150" x2="5150" y2="2470" type="Wall" target=""/>
      <linesegment x1="5150" y1="2470" x2="4760" y2="2470" type="Wall" target=""/>
      <linesegment x1="4760" y1="2470" x2="4760" y2="2325" type="Wall" target=""/>
      <linesegment x1="4760" y1="2325" x2="4760" y2="2235" type="Portal" target="open_office"/>
      <linesegment x1="4760" y1="2235" x2="4760" y2="1380" type="Wall" target=""/>
    </contour>
    <portal target="open_office"/>
    <portal target="corridor"/>
  </space>
  <space name="office_8" type="office">
    <contour>
      <centroid x="3120" y="910"/>
      <linesegment x1="2920" y1="700" x2="3320" y2="700" type="Wall" target=""/>
      <linesegment x1="3320" y1="700" x2="3320" y2="1120" type="Wall" target=""/>
      <linesegment x1="3320" y1="1120" x2="3165" y2="1120" type="Wall" target=""/>
      <linesegment x1="3165" y1="1120" x2="3075" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="3075" y1="1120" x2="2920" y2="1120" type="Wall" target=""/>
      <linesegment x1="2920" y1="1120" x2="2920" y2="700" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="office_9" type="office">
    <contour>
      <centroid x="3540" y="910"/>
      <linesegment x1="3340" y1="700" x2="3495" y2="700" type="Wall" target=""/>
      <linesegment x1="3495" y1="700" x2="3585" y2="700" type="Portal" target="passage"/>
      <linesegment x1="3585" y1="700" x2="3740" y2="700" type="Wall" target=""/>
      <linesegment x1="3740" y1="700" x2="3740" y2="1120" type="Wall" target=""/>
      <linesegment x1="3740" y1="1120" x2="3340" y2="1120" type="Wall" target=""/>
      <linesegment x1="3340" y1="1120" x2="3340" y2="700" type="Wall" target=""/>
    </contour>
    <portal target="passage"/>
  </space>
  <space name="office_10" type="office">
    <contour>
      <centroid x="3960" y="910"/>
      <linesegment x1="3760" y1="700" x2="4160" y2="700" type="Wall" target=""/>
      <linesegment x1="4160" y1="700" x2="4160" y2="1120" type="Wall" target=""/>
      <linesegment x1="4160" y1="1120" x2="4005" y2="1120" type="Wall" target=""/>
      <linesegment x1="4005" y1="1120" x2="3915" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="3915" y1="1120" x2="3760" y2="1120" type="Wall" target=""/>
      <linesegment x1="3760" y1="1120" x2="3760" y2="700" type="Wall" target=""/>
    </contour>
    <portal target="corridor"/>
  </space>
  <space name="office_11" type="office">
    <contour>
      <centroid x="4380" y="910"/>
      <linesegment x1="4180" y1="700" x2="4335" y2="700" type="Wall" target=""/>
      <linesegment x1="4335" y1="700" x2="4425" y2="700" type="Portal" target="passage"/>
      <linesegment x1="4425" y1="700" x2="4580" y2="700" type="Wall" target=""/>
      <linesegment x1="4580" y1="700" x2="4580" y2="1120" type="Wall" target=""/>
      <linesegment x1="4580" y1="1120" x2="4180" y2="1120" type="Wall" target=""/>
      <linesegment x1="4180" y1="1120" x2="4180" y2="700" type="Wall" target=""/>
    </contour>
    <portal target="passage"/>
  </space>
  <space name="passage" type="corridor">
    <contour>
      <centroid x="3750" y="580"/>
      <linesegment x1="2920" y1="480" x2="3055" y2="480" type="Wall" target=""/>
      <linesegment x1="3055" y1="480" x2="3145" y2="480" type="Portal" target="archive"/>
      <linesegment x1="3145" y1="480" x2="4255" y2="480" type="Wall" target=""/>
      <linesegment x1="4255" y1="480" x2="4345" y2="480" type="Portal" target="robotics"/>
      <linesegment x1="4345" y1="480" x2="4580" y2="480" type="Wall" target=""/>
      <linesegment x1="4580" y1="480" x2="4580" y2="490" type="Wall" target=""/>
      <linesegment x1="4580" y1="490" x2="4580" y2="670" type="Portal" target="hall"/>
      <linesegment x1="4580" y1="670" x2="4580" y2="680" type="Wall" target=""/>
      <linesegment x1="4580" y1="680" x2="4425" y2="680" type="Wall" target=""/>
      <linesegment x1="4425" y1="680" x2="4335" y2="680" type="Portal" target="office_11"/>
      <linesegment x1="4335" y1="680" x2="3585" y2="680" type="Wall" target=""/>
      <linesegment x1="3585" y1="680" x2="3495" y2="680" type="Portal" target="office_9"/>
      <linesegment x1="3495" y1="680" x2="2920" y2="680" type="Wall" target=""/>
      <linesegment x1="2920" y1="680" x2="2920" y2="480" type="Portal" target="corridor_south"/>
    </contour>
    <portal target="office_9"/>
    <portal target="office_11"/>
    <portal target="corridor_south"/>
    <portal target="hall"/>
    <portal target="archive"/>
    <portal target="robotics"/>
  </space>
  <space name="archive" type="archive">
    <contour>
      <centroid x="3305" y="245"/>
      <linesegment x1="2920" y1="30" x2="3690" y2="30" type="Wall" target=""/>
      <linesegment x1="3690" y1="30" x2="3690" y2="460" type="Wall" target=""/>
      <linesegment x1="3690" y1="460" x2="3145" y2="460" type="Wall" target=""/>
      <linesegment x1="3145" y1="460" x2="3055" y2="460" type="Portal" target="passage"/>
      <linesegment x1="3055" y1="460" x2="2920" y2="460" type="Wall" target=""/>
      <linesegment x1="2920" y1="460" x2="2920" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="passage"/>
  </space>
  <space name="robotics" type="laboratory">
    <contour>
      <centroid x="4145" y="245"/>
      <linesegment x1="3710" y1="30" x2="4580" y2="30" type="Wall" target=""/>
      <linesegment x1="4580" y1="30" x2="4580" y2="460" type="Wall" target=""/>
      <linesegment x1="4580" y1="460" x2="4345" y2="460" type="Wall" target=""/>
      <linesegment x1="4345" y1="460" x2="4255" y2="460" type="Portal" target="passage"/>
      <linesegment x1="4255" y1="460" x2="3710" y2="460" type="Wall" target=""/>
      <linesegment x1="3710" y1="460" x2="3710" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="passage"/>
  </space>
  <space name="hall" type="hall">
    <contour>
      <centroid x="5035" y="575"/>
      <linesegment x1="4600" y1="30" x2="5470" y2="30" type="Wall" target=""/>
      <linesegment x1="5470" y1="30" x2="5470" y2="1120" type="Window" target=""/>
      <linesegment x1="5470" y1="1120" x2="5120" y2="1120" type="Wall" target=""/>
      <linesegment x1="5120" y1="1120" x2="4940" y2="1120" type="Portal" target="corridor"/>
      <linesegment x1="4940" y1="1120" x2="4600" y2="1120" type="Wall" target=""/>
      <linesegment x1="4600" y1="1120" x2="4600" y2="670" type="Wall" target=""/>
      <linesegment x1="4600" y1="670" x2="4600" y2="490" type="Portal" target="passage"/>
      <linesegment x1="4600" y1="490" x2="4600" y2="30" type="Wall" target=""/>
    </contour>
    <portal target="passage"/>
    <portal target="corridor"/>
  </space>
</floor>
)xml";

}  // namespace examples
