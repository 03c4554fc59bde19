"""命令 ``cam``。"""

WORDS = {
    "summary": "凸轮：轮廓、校核、线图、铣削点",
    "description": """\
由文件中的运动循环设计凸轮：滚子、尖底或平底从动件，直动或摆动；槽凸轮、共轭凸轮、
圆柱凸轮的轮廓；压力角、曲率、根切、弹簧、接触力与接触应力、转矩、振动；未给出的
基圆、偏距、滚子和弹簧由程序选定。""",
    "examples": """\
linkwright cam gallery:cam_flat_face
linkwright cam gallery:cam_roller --plot motion.svg --draw cam.svg
linkwright cam gallery:cam_roller --kind cam_profile --plot pressure.svg
linkwright cam gallery:cam_roller --profile cam.dxf --points 1440""",
    "kind_help": "--plot 的线图种类",
    "profile_help": "把轮廓写入 .dxf、.csv 或 .txt 文件（铣削用，x y z，mm）",
    "points_help": "轮廓的点数（默认 720）",
    "draw_help": "把凸轮和从动件画入 .svg、.pdf 或 .png 文件",
    "at_help": "图中凸轮的转角，度（默认 0）",
    "bad_angle": "--at 为 {angle}；请给以度为单位的角度",
}
