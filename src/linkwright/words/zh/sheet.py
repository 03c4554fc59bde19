"""命令 ``sheet`` 与图纸上的文字。"""

WORDS = {
    "summary": "A0～A4 图纸：机构简图、多边形、线图、表格和标题栏",
    "description": """\
绘制课程设计图纸：按标准比例画出机构的一个或两个位置，速度、加速度和力多边形，
一个循环的线图和表格，带图框和标题栏；凸轮则画出轮廓。图上 1 毫米即纸上 1 毫米。
文件的 sheet 一节填写标题栏，并可移动、缩放或略去各个图。""",
    "examples": """\
linkwright sheet gallery:shaper_quick_return
linkwright sheet shaper.yaml --size A2 --output shaper.dxf
linkwright sheet shaper.yaml --size A1 --lang zh""",
    "size_help": "图幅，A0～A4（默认：文件所写，否则 A1）",
    "kind_help": "mechanism 或 cam（默认：按文件内容）",
    "of_help": "有几个时指明画哪一个：凸轮副的名称",
    "output_help": "要写的文件：.pdf、.svg 或 .dxf（默认：模型名，.pdf）",
    "bad_ending": "图纸不能写成“{ending}”；请用 {endings}",
    "bad_size": "没有图幅“{size}”；可用 {sizes}",
    "no_kind": "没有“{kind}”的图纸；可画的有 {kinds}",
    "no_panel": "图纸上没有图“{name}”；{hint}",
    "outside": "sheet.panels.{name}：此图连同图名为 {width} mm × {height} mm，超出图框；图框从 ({left}; {bottom}) 到 "
    "({right}; {top}) mm；请改 at，或用 size 缩小",
    "no_room": "{size} 放不下：{names}。请用更大的图幅，或用 leave_out 略去别的图。",
    "print_full_size": "按 100 % 打印：此线长 100 mm。",
    "drawing_mechanism": "机构运动及动力分析",
    "drawing_cam": "凸轮设计",
    "block.mark": "标记",
    "block.places": "处数",
    "block.zone": "分区",
    "block.change_file": "更改文件号",
    "block.signature": "签名",
    "block.day": "年月日",
    "block.designed": "设计",
    "block.adviser": "指导",
    "block.checked": "审核",
    "block.process": "工艺",
    "block.standardised": "标准化",
    "block.approved": "批准",
    "block.stage": "阶段标记",
    "block.mass": "重量",
    "block.scale": "比例",
    "block.sheet_of": "共 {sheets} 张　第 {sheet} 张",
    "block.number": "图号",
    "block.class": "班级",
    "block.student_number": "学号",
    "block.department": "负责部门",
    "block.reference": "技术联系",
    "block.created": "设计",
    "block.approved_by": "审核",
    "block.owner": "单位名称",
    "block.title": "图样名称",
    "block.kind": "文件类型",
    "block.kind_value": "机构简图",
    "block.identification": "图样代号",
    "block.date": "日期",
    "block.language": "语言",
    "block.language_value": "zh",
    "block.sheet": "张次",
}
