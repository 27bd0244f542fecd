// SPDX-License-Identifier: MIT
#include "scenes/figure/painting.h"

namespace threefold::figure {

namespace {

std::vector<Vec2> sketched(std::initializer_list<Vec2> points) {
    std::vector<Vec2> places;
    for (const Vec2 p : points) places.push_back(sketch(p.x, p.y));
    return places;
}

} // namespace

Painting::Painting()
    : body_(sketched({{-40, 1420}, {-30, 1100}, {0, 930},   {60, 862},  {150, 815}, {215, 760}, {300, 700},
                      {450, 670},  {590, 690},  {660, 702}, {735, 706}, {800, 730}, {852, 785}, {874, 880},
                      {880, 1050}, {878, 1200}, {880, 1420}})),
      chest_(sketched({{352, 540}, {350, 640}, {330, 720}, {285, 790}, {230, 850}, {245, 905}, {450, 895}, {655, 905},
                       {665, 850}, {615, 780}, {575, 710}, {552, 640}, {550, 540}})),
      hair_(sketched({{450, 162}, {520, 172}, {578, 218}, {615, 295}, {636, 385}, {655, 470}, {672, 560}, {698, 640},
                      {716, 720}, {722, 800}, {702, 862}, {668, 884}, {640, 850}, {612, 785}, {588, 700}, {566, 620},
                      {548, 550}, {450, 500}, {350, 550}, {334, 620}, {314, 700}, {288, 785}, {262, 850}, {238, 878},
                      {205, 850}, {186, 790}, {188, 715}, {206, 635}, {234, 540}, {256, 445}, {264, 370}, {284, 285},
                      {324, 212}, {384, 172}})),
      face_(sketched({{437, 196}, {490, 208}, {530, 258}, {550, 330}, {552, 400}, {546, 455}, {530, 510}, {502, 555},
                      {470, 580}, {447, 584}, {424, 579}, {388, 553}, {350, 508}, {326, 455}, {318, 400}, {322, 330},
                      {342, 260}, {385, 210}})),
      cuff_(sketched({{-40, 900}, {20, 880}, {66, 905}, {84, 960}, {112, 1010}, {118, 1050}, {80, 1075}, {30, 1090},
                      {-40, 1100}})),
      left_band_(sketched({{150, 850}, {440, 1140}, {530, 1212}})),
      right_band_(sketched({{706, 872}, {440, 1136}, {262, 1312}})),
      neck_band_(curve_through(sketched({{240, 876}, {340, 868}, {447, 866}, {556, 870}, {654, 880}}), false, 3)),
      parting_left_(curve_through(
          sketched({{437, 168}, {352, 235}, {305, 350}, {290, 470}, {268, 600}, {248, 720}, {236, 870}}), false, 4)),
      parting_right_(curve_through(
          sketched({{447, 168}, {538, 230}, {585, 340}, {605, 460}, {632, 600}, {664, 720}, {684, 880}}), false, 4)) {}

Spot Painting::at(Vec2 p) const {
    Spot spot;
    spot.colour *= 1 + 0.5 * noise(p * 9.0, 3, 90);
    paint_chest(p, spot);
    paint_robe(p, spot);
    paint_bands(p, spot);
    paint_hair(p, spot);
    paint_face(p, spot);
    paint_sleeve(p, spot);
    paint_blessing_hand(p, spot);
    // Varnish and canvas: what keeps a painted surface from looking like plastic.
    spot.colour *= 1 + 0.06 * noise(p * 60.0, 3, 91);
    spot.colour = glm::clamp(spot.colour, Rgb(0), Rgb(1));
    return spot;
}

} // namespace threefold::figure
