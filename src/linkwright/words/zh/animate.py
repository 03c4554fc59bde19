"""命令 ``animate``。"""

WORDS = {
    "summary": "机构运动动画（SVG、GIF 或 MP4）",
    "description": """\
把机构的一个循环画成动画，可带点的轨迹、矢量，以及光标同步移动的曲线。
不闭合的循环往复播放。动态 SVG 在浏览器和说明文件中自行播放。""",
    "pace_title": "速度",
    "paths_help": "点的轨迹，带沿轨迹移动的圆点：C,jaw.D",
    "curves_help": "画在下方的结果：jaw.angle、C.velocity.x；有 --forces 时还可用 driver.effort",
    "labels_help": "点的名称",
    "seconds_help": "一个循环的播放时间（默认为实际时间，限于 2 至 6 s）",
    "frames_help": "一个循环内显示的位置数（默认 {frames}）",
    "output_help": "写入 FILE.svg、FILE.gif 或 FILE.mp4",
    "drawing": "绘制",
}
